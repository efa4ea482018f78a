// How many times as much as another thing one costs, both measured in turns.
//   in     costs of both, one of each for every turn; more than 0
//   out    the median of the ratios, turn by turn; NaN where there is no turn
//   invariants
//          what slows both in a turn alike moves nothing, and a turn in which one alone was held up
//          counts as one turn, however long
//   cost   O(turns)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

namespace pitwall::cost {

double paired_ratio(std::span<const double> ours, std::span<const double> theirs);

}  // namespace pitwall::cost
