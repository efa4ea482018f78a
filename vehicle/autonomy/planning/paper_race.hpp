// The published planner's choice of a primitive, for comparison: Maintain, Trail or Safe Merge, by
// role and flag and by who is ahead at this tick.
//   invariants
//          behind: the attacker trails on green; on waving green it merges to the other line and
//          drives at the speed of a pass
//          ahead: it is the leader, and maintains the round speed; from the rule's gap on it merges
//          back to its own line
//          no state but the line: each tick decides anew
//   source Saba et al., on planning; research notes state what the paper leaves open: which line
//          (here the first other one) and the speed of a pass (here that of pass.hpp)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "vehicle/autonomy/planning/pass.hpp"

namespace pitwall::planning {

PassState advance_paper(const PassParams& params, const PassState& state, const PassInputs& in,
                        std::size_t lines, Instant now);

}  // namespace pitwall::planning
