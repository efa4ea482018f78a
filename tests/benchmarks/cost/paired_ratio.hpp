// Ratio of two costs that are measured in alternation.
//   in     costs of both, one of each per turn; more than 0
//   out    the median over the turns of the ratio in each turn; NaN without a turn
//   invariants
//          a disturbance that slows both in a turn does not change the ratio; a turn in which only
//          one was delayed counts as one turn, independent of the delay
//   cost   O(turns)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

namespace pitwall::cost {

double paired_ratio(std::span<const double> ours, std::span<const double> theirs);

}  // namespace pitwall::cost
