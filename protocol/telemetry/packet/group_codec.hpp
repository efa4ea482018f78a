// Values of groups as bits, and the ages of their samples as four bits each.
//   law    |decoded - value| <= resolution / 2 inside a field's range; a value out of range is
//          written as its end and counted; NaN is "unset"; an infinite value is written as unset
//          and counted
//          an age is rounded up: the receiver never takes a sample for younger than it is. One of
//          more than an hour is written as "never sampled"
//   errors encode: false where the group did not fit; the writer takes no more then
//          decode: false where a bit pattern is none that encode makes; the values are untouched
//   cost   no allocation; encode 300 ns, decode 400 ns for a hundred fields
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "protocol/bits/bit_reader.hpp"
#include "protocol/bits/bit_writer.hpp"
#include "protocol/telemetry/registry/registry.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::telemetry {

struct CodecCounters {
  std::uint64_t saturated = 0, not_finite = 0;
};

bool encode_group(Group group, const Values& values, bits::BitWriter& out, CodecCounters& counters);
bool decode_group(Group group, bits::BitReader& in, Values& values);

inline constexpr unsigned kAgeCodeBits = 4;
inline constexpr std::uint8_t kNeverCode = 15;  // never sampled
std::uint8_t age_code(Duration age);            // the smallest code that is at least this old
Duration age_of_code(std::uint8_t code);        // code < kNeverCode

}  // namespace pitwall::telemetry
