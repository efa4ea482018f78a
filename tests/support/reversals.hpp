// Reversals of a signal by more than a metre per second, from extreme to extreme.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>

#include "protocol/vocabulary/units.hpp"

namespace pitwall::testing {

class Reversals {
 public:
  void take(double mps) {
    if (std::isnan(extreme_mps_)) extreme_mps_ = mps;
    const double moved_mps = mps - extreme_mps_;
    if (direction_ * moved_mps > 0.0) extreme_mps_ = mps;
    const bool begins = direction_ == 0 && std::abs(moved_mps) > kLeast_mps;
    if (!begins && !(direction_ * moved_mps < -kLeast_mps)) return;
    if (!begins) ++count_;
    direction_ = moved_mps > 0.0 ? 1 : -1;
    extreme_mps_ = mps;
  }
  std::size_t count() const { return count_; }

 private:
  static constexpr double kLeast_mps = 1.0;
  double extreme_mps_ = kUnset;
  int direction_ = 0;
  std::size_t count_ = 0;
};

}  // namespace pitwall::testing
