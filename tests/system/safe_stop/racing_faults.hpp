// Faults at racing speed, all from the same state to the byte. The car drives from rest to a turn
// of Las Vegas; there the process forks once for each fault. A fault that cannot be detected while
// the car drives is followed by the operator's stop.
//   in     the modelled car
//   out    RacingFigures of every fault, computed from the true state of the plant
//   errors if the car does not reach the place, every fault has begun == false
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
  kBrakeFree,   // the pressure stays zero
  kBrakeDrags,  // a pressure that stays applied
  kFrontBrakeLost,
  kRearBrakeLost,
  kPositions,  // the receivers report 1000 times their deviation
  kImus,       // no inertial sample
  // A stop on the track is not promised for these: see impact_bound.hpp.
  kSteeringStuck,
  kReference,  // both receivers, with their inertial units
  kComputer    // car process and guardian
};
inline constexpr std::size_t kRacingFaults = 11;
const char* text_of(RacingFault fault);

struct RacingFigures {
  bool begun = false, stood = false, contact = false;
  double from_mps = kUnset, lasted_s = 0.0, distance_m = 0.0;
  double impact_mps = 0.0, normal_mps = 0.0;  // at the wall: whole speed, and normal to it
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
