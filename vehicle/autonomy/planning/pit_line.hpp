// Way through the pit lane to the box and out again: a closed line that leaves the track where the
// pit lane begins and is back on it where that ends, and when the car changes to it.
//   in     the map with its pit lane; the line that it leaves; once a step the flags' demand
//   out    PitLine; the line that the car shall be on, and the speed with which it comes to its box
//   invariants
//          the car changes to the pit line only where comfortable braking brings it to the pit
//          lane's speed before that begins: else it goes round once more
//          in the pit lane the line's speed is speed_margin below its limit, whatever the demand
//          a car that is to come in stops at its box; one that is past the box drives out
//   errors a pit lane so short or so far aside that no line leads into it
//   source what a track file says of a pit lane: its ends, its middle, its width, its speed limit
//   cost   pit_line() at start-up only; the rest O(1), no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>

#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/autonomy/planning/line.hpp"
#include "vehicle/envelope/envelope_table.hpp"
#include "vehicle/world/track_map.hpp"

namespace pitwall::planning {

struct PitLine {
  Line line;
  double entry_s_m = kUnset, exit_s_m = kUnset, box_s_m = kUnset;  // along the line
  double limit_mps = kUnset;
};

// None where the map has no pit lane.
Result<std::optional<PitLine>, Problem> pit_line(
    const world::TrackMap& track, const LineParams& params, const Line& own,
    const std::optional<envelope::SteeringLimit>& steering);

struct OnTheWay {
  double s_m = kUnset;  // of the car along the pit line
  double speed_mps = kUnset;
  double merge_m = kUnset;     // that a change of line takes
  double decel_mps2 = kUnset;  // comfortable
};

// Whether a car on the track that is to come in leaves its line now.
bool turns_in(const PitLine& pit, const OnTheWay& car);
bool is_in_lane(const PitLine& pit, double s_m);
// Speed with which a car on the pit line comes to the begin of the lane.
double to_lane_mps(const PitLine& pit, const OnTheWay& car);
// Speed with which a car on the pit line comes to its box; no limit for one that is past it.
double to_box_mps(const PitLine& pit, const OnTheWay& car);

}  // namespace pitwall::planning
