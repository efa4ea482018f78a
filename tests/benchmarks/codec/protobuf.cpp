// SPDX-License-Identifier: Apache-2.0
#include <state.pb.h>

#include "tests/benchmarks/codec/peer.hpp"

// state_fields.inc, which the build writes: REAL(1) to REAL(84), INTEGER(1).., YES_NO(1)..
namespace pitwall::codec {
namespace {

template <class Message, class Real>
Peer contestant(const char* name, Keeps keeps) {
  const auto encode = [](const Values& v, std::span<std::uint8_t> out) {
    static Message message;
    message.Clear();
#define REAL(n) message.set_f##n(static_cast<Real>(v[kReals[n - 1]]));
#define INTEGER(n) message.set_i##n(integer_of(v, n - 1));
#define YES_NO(n) message.set_b##n(yes_no_of(v, n - 1));
#include <state_fields.inc>
#undef REAL
#undef INTEGER
#undef YES_NO
    const std::size_t size = message.ByteSizeLong();
    message.SerializeWithCachedSizesToArray(out.data());
    return size;
  };
  const auto decode = [](Bytes bytes, Values& v) {
    static Message message;
    if (!message.ParseFromArray(bytes.data(), static_cast<int>(bytes.size()))) return false;
#define REAL(n) v[kReals[n - 1]] = static_cast<double>(message.f##n());
#define INTEGER(n) v[kIntegers[n - 1]] = message.i##n();
#define YES_NO(n) v[kYesNos[n - 1]] = message.b##n() ? 1 : 0;
#include <state_fields.inc>
#undef REAL
#undef INTEGER
#undef YES_NO
    return true;
  };
  return {name, "protoc, libprotobuf", keeps, encode, decode};
}

}  // namespace

std::vector<Peer> protobuf() {
  return {contestant<codec_schema::State32, float>("protobuf, float", Keeps::kFloat),
          contestant<codec_schema::State64, double>("protobuf, double", Keeps::kDouble)};
}

}  // namespace pitwall::codec
