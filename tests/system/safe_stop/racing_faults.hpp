// Faults at racing speed, all from the same bytes: the car drives from rest to a turn of Las Vegas,
// and there each fault happens once, in a process that is forked off. What nobody can notice while
// the car drives is followed by the operator's stop.
//   in     the modelled car
//   out    RacingFigures of every fault, judged by what is true of the plant
//   errors a lead-in that does not reach the place: every fault has begun == false
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "hil/plant/params.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::testing {

enum class RacingFault : std::uint8_t {
  kSteeringSlow,  // kSlowMotor
  kThrottleStuck,
  kBrakeFree,   // no pressure comes any more
  kBrakeDrags,  // a pressure that never goes
  kFrontBrakeLost,
  kRearBrakeLost,
  kPositions,  // no receiver solves
  kImus,       // no inertial sample
  // A stop on the track is not promised: impact_bound.hpp.
  kSteeringStuck,
  kReference,  // both
  kComputer    // car process and guardian
};
inline constexpr std::size_t kRacingFaults = 11;
const char* text_of(RacingFault fault);

struct RacingFigures {
  bool begun = false, stood = false, contact = false;
  double from_mps = kUnset, lasted_s = 0.0, distance_m = 0.0;
  double impact_mps = 0.0, normal_mps = 0.0;  // normal to the wall
  double slip_deg = 0.0;                      // largest slip angle of the car, above 5 m/s
  double wall_gap_m = 1e9;
  double end_mps = kUnset;
};
using RacingResults = std::array<RacingFigures, kRacingFaults>;

inline constexpr double kRacingTurn_m = 700.0;  // station of the turn
inline constexpr double kSlowMotor_rad_per_s = 0.1047;

RacingResults race_into_faults(const plant::Params& plant);
std::string row_of(RacingFault fault, const RacingFigures& figures);

}  // namespace pitwall::testing
