// SPDX-License-Identifier: Apache-2.0
#include "basestation/state/derived/gap.hpp"

#include <algorithm>
#include <cmath>

namespace pitwall::state {
namespace {

void keep_nearer(Gap& nearest, const Gap& one) {
  if (!(nearest.metres <= one.metres)) nearest = one;
}

}  // namespace

Gaps gaps_of(const Runner& own, std::span<const Runner> opponents, double course_m) {
  Gaps gaps;
  if (!(course_m > 0.0)) return gaps;
  for (const Runner& other : opponents) {
    const double apart_m = std::remainder(other.station_m - own.station_m, course_m);
    if (std::isnan(apart_m)) continue;
    const double clear_m = std::max(0.0, std::abs(apart_m) - kCarLength_m);
    const double faster_mps = own.speed_mps - other.speed_mps;
    if (apart_m >= 0.0 || clear_m == 0.0) keep_nearer(gaps.ahead, {clear_m, faster_mps});
    if (apart_m < 0.0 || clear_m == 0.0) keep_nearer(gaps.behind, {clear_m, -faster_mps});
  }
  return gaps;
}

}  // namespace pitwall::state
