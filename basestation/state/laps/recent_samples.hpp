// The last samples of one field, for its value at a time between two of them.
//   out    linear between two samples; NaN: unknown, or in a gap, or before what is kept;
//          nullopt: its next sample has not come yet
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>

#include "protocol/vocabulary/time.hpp"

namespace pitwall::state {

class RecentSamples {
 public:
  static constexpr std::size_t kKept = 64;  // more than a second of 50 a second

  void note(Instant at, double value) {
    if (count_ > 0 && at <= nth(count_ - 1).at) return;
    if (count_ == kKept) {
      first_ = (first_ + 1) % kKept;
    } else {
      ++count_;
    }
    samples_[(first_ + count_ - 1) % kKept] = {at, value};
  }

  std::optional<float> value_at(Instant at, Duration gap) const {
    constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
    if (count_ == 0 || nth(count_ - 1).at < at) return std::nullopt;
    std::size_t after = count_ - 1;
    while (after > 0 && nth(after - 1).at >= at) --after;
    const Sample& to = nth(after);
    if (to.at == at) return static_cast<float>(to.value);
    if (after == 0) return kUnknown;
    const Sample& from = nth(after - 1);
    if (to.at - from.at > gap) return kUnknown;
    const double share = (at - from.at).seconds() / (to.at - from.at).seconds();
    return static_cast<float>(from.value + share * (to.value - from.value));
  }

 private:
  struct Sample {
    Instant at{};
    double value = 0.0;
  };
  const Sample& nth(std::size_t n) const { return samples_[(first_ + n) % kKept]; }

  std::array<Sample, kKept> samples_{};
  std::size_t first_ = 0, count_ = 0;
};

}  // namespace pitwall::state
