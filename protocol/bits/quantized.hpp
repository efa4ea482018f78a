// Quantised number: a value of a known range in few bits; step k means min + k * resolution.
//   in      min < max and resolution > 0, all finite (checked); at most 32 bits
//   out     steps 0 to count() - 1; the largest value of the field means "no value" (NaN)
//   rule    rounded half away from zero, limited to the range, infinities too; NaN stays NaN
//   errors  a received step beyond the range decodes to NaN
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstdint>

#include "protocol/vocabulary/check.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::bits {

struct Encoded {
  std::uint64_t step = 0;
  bool saturated = false;
};

class Quantized {
 public:
  constexpr Quantized(double min, double max, double resolution)
      : min_(min), max_(max), resolution_(resolution) {
    CHECK(min < max && resolution > 0.0 && max - min <= kLargest);
    const double steps = (max - min) / resolution;
    CHECK(steps >= 0.5 && steps < 4294967294.0);
    last_ = rounded(steps);
    past_last_ = static_cast<double>(last_) + 0.5;
    bits_ = static_cast<unsigned>(std::bit_width(last_ + 1));
  }

  constexpr double min() const { return min_; }
  constexpr double max() const { return max_; }
  constexpr double resolution() const { return resolution_; }
  constexpr std::uint64_t count() const { return last_ + 1; }
  // Width for all steps and one more pattern: all ones is "no value".
  constexpr unsigned bits() const { return bits_; }
  constexpr std::uint64_t no_value() const { return (std::uint64_t{1} << bits_) - 1; }

  constexpr Encoded encode(double value) const {
    if (value != value) return {no_value(), false};
    const double steps = (value - min_) / resolution_;
    if (!(steps > -0.5)) return {0, value < min_};
    if (steps >= past_last_) return {last_, true};
    const std::uint64_t step = steps < 0.0 ? 0 : rounded(steps);
    return {step > last_ ? last_ : step, false};
  }
  constexpr double decode(std::uint64_t step) const {
    if (step > last_) return kUnset;
    return min_ + static_cast<double>(static_cast<std::int64_t>(step)) * resolution_;
  }

 private:
  static constexpr double kLargest = 1e300;
  // Via signed numbers, which processors convert in one instruction; there are at most 2^32 steps.
  static constexpr std::uint64_t rounded(double v) {
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(v + 0.5));
  }

  double min_, max_, resolution_;
  double past_last_ = 0.0;  // in steps
  std::uint64_t last_ = 0;
  unsigned bits_ = 0;
};

}  // namespace pitwall::bits
