// Bit codec of the groups' values, and of the ages of their samples as four bits each.
//   invariants
//          |decoded - value| <= resolution / 2 inside the range of a field. A value out of range is
//          saturated and counted; NaN is "unset"; an infinite value is written as unset and counted
//          an age is rounded up, so that a sample never appears younger than it is. An age of more
//          than an hour is written as "never sampled"
//   errors encode: false if the group does not fit; the writer then accepts no more
//          decode: false if a bit pattern encodes no value; the group's values are then unset. If
//          there are too few bits the values stay unchanged
//   cost   no allocation; encode 300 ns, decode 400 ns for a hundred fields
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "protocol/bits/bit_stream.hpp"
#include "protocol/telemetry/registry/registry.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::telemetry {

struct CodecCounters {
  std::uint64_t saturated = 0, not_finite = 0;
};

// Writer of consecutive fields of at most 32 bits. It gathers them into words of 32 bits, because
// one write per word is faster than one per field. The word stays in registers during a call.
class FieldWriter {
 public:
  explicit FieldWriter(bits::BitWriter& out) : out_(out) {}
  // Calls fields(put), which calls put(value, bits) for each field.
  template <class Fields>
  void write(Fields&& fields) {
    std::uint64_t word = word_;
    unsigned filled = filled_;
    fields([&](std::uint64_t value, unsigned bits) {
      word = word << bits | value;
      filled += bits;
      if (filled < kWord) return;
      filled -= kWord;
      out_.write(word >> filled & 0xFFFF'FFFFU, kWord);
    });
    word_ = word;
    filled_ = filled;
  }
  // Writes the rest of the last word. Returns false if not all fields fitted.
  bool finish() { return out_.write(word_ & ((std::uint64_t{1} << filled_) - 1), filled_); }

 private:
  static constexpr unsigned kWord = 32;

  bits::BitWriter& out_;
  std::uint64_t word_ = 0;
  unsigned filled_ = 0;  // < kWord between two fields
};

// Reader of such fields; `total`: number of bits to read, which the caller has checked.
class FieldReader {
 public:
  FieldReader(bits::BitReader& in, std::size_t total) : in_(in), left_(total) {}
  // Returns the result of fields(take), which calls take(bits) for each field.
  template <class Fields>
  bool read(Fields&& fields) {
    std::uint64_t word = word_;
    unsigned filled = filled_;
    const bool good = fields([&](unsigned bits) {
      if (filled < bits) {
        const auto more = static_cast<unsigned>(left_ < kWord ? left_ : kWord);
        word = word << more | in_.read(more);
        filled += more;
        left_ -= more;
      }
      filled -= bits;
      return word >> filled & ((std::uint64_t{1} << bits) - 1);
    });
    word_ = word;
    filled_ = filled;
    return good;
  }

 private:
  static constexpr unsigned kWord = 32;

  bits::BitReader& in_;
  std::uint64_t word_ = 0;
  unsigned filled_ = 0;
  std::size_t left_;
};

void encode_group(Group group, const Values& values, FieldWriter& out, CodecCounters& counters);
bool decode_group(Group group, FieldReader& in, Values& values);
// The same for one group alone.
bool encode_group(Group group, const Values& values, bits::BitWriter& out, CodecCounters& counters);
bool decode_group(Group group, bits::BitReader& in, Values& values);

inline constexpr unsigned kAgeCodeBits = 4;
inline constexpr std::uint8_t kNeverCode = 15;  // never sampled
std::uint8_t age_code(Duration age);            // the smallest code whose age is at least `age`
Duration age_of_code(std::uint8_t code);        // code < kNeverCode

}  // namespace pitwall::telemetry
