// Road of a raceline for its speed profile, and the profiles of all lines of a bank.
//   in     a raceline or a bank; the lanes of its track; the envelope of the car
//   out    the points of the road, in the pit lane with its speed limit; the lines that have none
//          with their profiles and lap times
//   errors a line that the car cannot drive at any speed, with the arc length
//   cost   O(points)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "protocol/vocabulary/result.hpp"
#include "vehicle/envelope/envelope_table.hpp"
#include "vehicle/envelope/lap_profile.hpp"
#include "vehicle/raceline/lanes/lanes.hpp"
#include "vehicle/raceline/lanes/raceline.hpp"

namespace pitwall::raceline {

using envelope::LapOutcome;
using envelope::LapProfile;
using envelope::RoadStep;

std::vector<RoadStep> road_of(const Raceline& line, const Lanes& lanes);

std::optional<Problem> add_laps(RacelineBank& bank, const Lanes& lanes,
                                const envelope::EnvelopeTable& table);

}  // namespace pitwall::raceline
