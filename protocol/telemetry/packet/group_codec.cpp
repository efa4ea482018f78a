// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/packet/group_codec.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace pitwall::telemetry {
namespace {

// A row as the codec needs it.
struct FieldCode {
  double min, resolution;
  double per_unit;    // steps
  std::int64_t last;  // code of the last value
  unsigned bits;
  std::uint64_t unset;
};
constexpr auto kCodes = [] {
  std::array<FieldCode, kFieldCount> codes{};
  for (FieldIndex i = 0; i < kFieldCount; ++i) {
    const bits::Quantized q = kFields[i].quantized();
    const auto last = static_cast<std::int64_t>(q.count()) - 1;
    codes[i] = {q.min(), q.resolution(), 1.0 / q.resolution(), last, q.bits(), q.no_value()};
  }
  return codes;
}();

// A value that has no code inside the range: unset, infinite, or held at an end.
std::uint64_t code_outside(FieldIndex i, double value, CodecCounters& counters) {
  if (std::isinf(value)) {
    ++counters.not_finite;
    return kCodes[i].unset;
  }
  const bits::Encoded encoded = kFields[i].quantized().encode(value);
  if (encoded.saturated) ++counters.saturated;
  return encoded.step;
}

std::uint64_t code_of(FieldIndex i, double value, CodecCounters& counters) {
  const FieldCode& code = kCodes[i];
  const double steps = (value - code.min) * code.per_unit;
  const bool inside = steps >= 0.0 && steps <= static_cast<double>(code.last);
  if (!inside) return code_outside(i, value, counters);
  return static_cast<std::uint64_t>(static_cast<std::int64_t>(steps + 0.5));
}

// Dense where fast groups live (a tick of 10 ms, a slot of 20 ms), about threefold above.
constexpr std::array kAges{milliseconds(0),  milliseconds(2),  milliseconds(4),   milliseconds(6),
                           milliseconds(8),  milliseconds(10), milliseconds(14),  milliseconds(20),
                           milliseconds(30), milliseconds(50), milliseconds(100), milliseconds(250),
                           seconds(1),       seconds(10),      seconds(3'600)};
static_assert(kAges.size() == kNeverCode);
static_assert(std::is_sorted(kAges.begin(), kAges.end()));

}  // namespace

void encode_group(Group group, const Values& values, FieldWriter& out, CodecCounters& counters) {
  const auto [first, count] = fields_of(group);
  out.write([&, first = first, end = first + count](auto&& put) {
    for (FieldIndex i = first; i < end; ++i) put(code_of(i, values[i], counters), kCodes[i].bits);
  });
}

bool decode_group(Group group, FieldReader& in, Values& values) {
  const auto [first, count] = fields_of(group);
  const bool good = in.read([&, i = first, end = first + count](auto&& take) mutable {
    for (; i < end; ++i) {
      const FieldCode& code = kCodes[i];
      const std::uint64_t step = take(code.bits);
      const auto number = static_cast<std::int64_t>(step);
      if (number <= code.last) {
        values[i] = code.min + static_cast<double>(number) * code.resolution;
      } else if (step == code.unset) {
        values[i] = kUnset;
      } else {
        return false;
      }
    }
    return true;
  });
  if (!good) std::fill_n(values.at.begin() + static_cast<std::ptrdiff_t>(first), count, kUnset);
  return good;
}

bool encode_group(Group group, const Values& values, bits::BitWriter& out,
                  CodecCounters& counters) {
  FieldWriter writer{out};
  encode_group(group, values, writer, counters);
  return writer.finish();
}

bool decode_group(Group group, bits::BitReader& in, Values& values) {
  if (in.bits_left() < group_bits(group)) return false;
  FieldReader reader{in, group_bits(group)};
  return decode_group(group, reader, values);
}

std::uint8_t age_code(Duration age) {
  const auto* const at = std::lower_bound(kAges.begin(), kAges.end(), age);
  return static_cast<std::uint8_t>(at - kAges.begin());  // past the end is kNeverCode
}

Duration age_of_code(std::uint8_t code) {
  CHECK(code < kNeverCode);
  return kAges[code];
}

}  // namespace pitwall::telemetry
