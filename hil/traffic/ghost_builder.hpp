// Ghost from its plan: lines and speeds of the names that the plan uses.
//   in     the plan, the track, the bank of racelines of this track; null: there is none
//   out    Ghost
//   errors Problem with the place in the plan: a raceline that the bank lacks, or that goes through
//          the pit; a share of a lap that the line does not have; a start, line or drift into a
//          wall; an entry that brakes harder than the limit, or that follows a spin; a drift faster
//          than the lateral limit
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hil/traffic/ghost.hpp"
#include "hil/traffic/ghost_plan.hpp"
#include "protocol/vocabulary/result.hpp"
#include "vehicle/world/raceline.hpp"
#include "vehicle/world/track_map.hpp"

namespace pitwall::traffic {

Result<Ghost, Problem> build_ghost(const GhostPlan& plan, const world::TrackMap& track,
                                   const world::RacelineBank* bank);

}  // namespace pitwall::traffic
