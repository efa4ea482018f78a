// The published planner's choice of a primitive, for comparison: Maintain, Trail or Safe Merge, by
// role and flag and by who is ahead at this tick.
//   invariants
//          behind: the attacker trails on green; on waving green it merges to the other line and
//          drives at the speed of a pass
//          ahead on waving green: the merge goes on, as fast as the car may, up to the rule's gap;
//          from there it merges back to its own line and maintains the round speed
//          ahead else: it is the leader, and maintains the round speed
//          no state but the line: each tick decides anew, so that a gap that is noisy around zero
//          changes the speed at every change of its sign
//   source Saba et al., on planning. It leaves open: which line (here the first other one), the
//          speed of a pass (here that of pass.hpp) and that of an attacker just ahead: the paper
//          passed up to 125 mph, so it is none that keeps the gap as it is
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "vehicle/autonomy/planning/pass.hpp"

namespace pitwall::planning {

PassState advance_paper(const PassParams& params, const PassState& state, const PassInputs& in,
                        std::size_t lines, Instant now);

}  // namespace pitwall::planning
