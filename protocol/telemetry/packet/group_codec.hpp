// Values of groups as bits, and the ages of their samples as four bits each.
//   invariants
//          |decoded - value| <= resolution / 2 inside a field's range; a value out of range is
//          written as its end and counted; NaN is "unset"; an infinite value is written as unset
//          and counted
//          an age is rounded up: the receiver never takes a sample for younger than it is. One of
//          more than an hour is written as "never sampled"
//   errors encode: false where the group did not fit; the writer takes no more then
//          decode: false where a bit pattern is none that encode makes; the group's values are
//          unset then, and untouched where too few bits were there
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

// Fields of at most 32 bits one after the other, gathered into words: 32 bits are written at once
// sooner than a few at a time. What is gathered stays in registers during a call.
class FieldWriter {
 public:
  explicit FieldWriter(bits::BitWriter& out) : out_(out) {}
  // fields(put), which calls put(value, bits).
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
  // The rest of the last word. False where not all did fit.
  bool finish() { return out_.write(word_ & ((std::uint64_t{1} << filled_) - 1), filled_); }

 private:
  static constexpr unsigned kWord = 32;

  bits::BitWriter& out_;
  std::uint64_t word_ = 0;
  unsigned filled_ = 0;  // < kWord between two fields
};

// The other way round; `total`: all bits that are taken, which are there.
class FieldReader {
 public:
  FieldReader(bits::BitReader& in, std::size_t total) : in_(in), left_(total) {}
  // What fields(take) returns, which calls take(bits).
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
// A group by itself.
bool encode_group(Group group, const Values& values, bits::BitWriter& out, CodecCounters& counters);
bool decode_group(Group group, bits::BitReader& in, Values& values);

inline constexpr unsigned kAgeCodeBits = 4;
inline constexpr std::uint8_t kNeverCode = 15;  // never sampled
std::uint8_t age_code(Duration age);            // the smallest code that is at least this old
Duration age_of_code(std::uint8_t code);        // code < kNeverCode

}  // namespace pitwall::telemetry
