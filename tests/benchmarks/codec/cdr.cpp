// SPDX-License-Identifier: Apache-2.0
#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>

#include "tests/benchmarks/codec/peer.hpp"

namespace pitwall::codec {
namespace {

using eprosima::fastcdr::Cdr;
using eprosima::fastcdr::FastBuffer;

// The narrowest of CDR's types that holds the field; `reach` writes or reads it.
template <class Reach>
void narrow(FieldIndex i, Reach&& reach) {
  constexpr double kByte = 255.0, kShort = 65'535.0;
  const double max = telemetry::kFields[i].max;
  if (max <= kByte) return reach(std::uint8_t{});
  if (max <= kShort) return reach(std::uint16_t{});
  return reach(std::uint32_t{});
}

template <class Real, bool kNarrow>
Peer contestant(const char* name, Keeps keeps) {
  const auto encode = [](const Values& v, std::span<std::uint8_t> out) {
    FastBuffer buffer(reinterpret_cast<char*>(out.data()), out.size());
    Cdr cdr(buffer, Cdr::DEFAULT_ENDIAN, Cdr::DDS_CDR);
    cdr.serialize_encapsulation();
    for (const FieldIndex i : kReals) cdr << static_cast<Real>(v[i]);
    for (const FieldIndex i : kIntegers) {
      if (kNarrow) {
        narrow(i, [&](auto type) { cdr << static_cast<decltype(type)>(v[i]); });
      } else {
        cdr << static_cast<std::int32_t>(v[i]);
      }
    }
    for (const FieldIndex i : kYesNos) cdr << (v[i] != 0.0);
    return cdr.getSerializedDataLength();
  };
  const auto decode = [](Bytes bytes, Values& v) {
    FastBuffer buffer(reinterpret_cast<char*>(const_cast<std::uint8_t*>(bytes.data())),
                      bytes.size());
    Cdr cdr(buffer, Cdr::DEFAULT_ENDIAN, Cdr::DDS_CDR);
    cdr.read_encapsulation();
    const auto take = [&](FieldIndex i, auto value) {
      cdr >> value;
      v[i] = static_cast<double>(value);
    };
    for (const FieldIndex i : kReals) take(i, Real{});
    for (const FieldIndex i : kIntegers) {
      if (kNarrow) {
        narrow(i, [&](auto type) { take(i, type); });
      } else {
        take(i, std::int32_t{});
      }
    }
    for (const FieldIndex i : kYesNos) take(i, bool{});
    return true;
  };
  return {name, "Fast CDR", keeps, encode, decode};
}

}  // namespace

std::vector<Peer> cdr() {
  return {contestant<float, false>("CDR, float", Keeps::kFloat),
          contestant<float, true>("CDR, float, narrow integers", Keeps::kFloat),
          contestant<double, false>("CDR, double", Keeps::kDouble)};
}

}  // namespace pitwall::codec
