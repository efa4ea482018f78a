// Stop of one car from speed at a place of Las Vegas Motor Speedway. The car starts from rest far
// enough before the place and drives at the speed that its planner allows. At the place the
// operator's switch disarms it: a controlled stop, or an emergency stop if the case says so.
// Sensors have noise and localization is in the loop; the figures come from the true state of the
// plant.
//   in     station, temperature of the tyres, what breaks at the stop
//   out    StopFigures; `planned` is the stop trajectory that was ready when the stop began
//   errors a run that cannot be built fails the test
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "protocol/vocabulary/units.hpp"
#include "vehicle/world/trajectory.hpp"

namespace pitwall::testing {

inline constexpr double kColdLoss = 0.35;  // loss of the modelled friction at 25 C

enum class Breakage : std::uint8_t {
  kNothing,
  kFullBrake,           // the stop is planned and followed without any limit
  kFrontBrakes,         // the front brakes have half their torque: the rear wheels lock first
  kFullRearBrake,       // kFullBrake and kFrontBrakes
  kPlanning,            // planning is dead from the first tick of the stop
  kControl,             // the output of control is unusable
  kPlanningAndControl,  // both
  kPositions,           // only IMU samples of the receivers, from 4 s after the beginning
  kSensors              // no sample of any receiver, from 4 s after the beginning
};
const char* text_of(Breakage breakage);

struct StopCase {
  double station_m = 0.0;
  double tyre_c = 85.0;
  Breakage breakage = Breakage::kNothing;
  bool emergency = false;
};

struct StopFigures {
  bool begun = false, stood = false, contact = false;
  double from_mps = kUnset, from_bank_deg = kUnset;
  double distance_m = 0.0, lasted_s = kUnset;
  double cross_track_m = 0.0;  // largest distance of the true position from the planned path
  double use = 0.0;            // largest share of its friction that a tyre uses
  double use_before = 0.0;     // likewise, in the second before the stop begins
  double jerk_mps3 = 0.0;      // largest, of the true forward acceleration over 0.2 s
  double planned_jerk_mps3 = 0.0;
  double decel_mps2 = 0.0, slip_deg = 0.0;
  bool front_locked = false, rear_locked = false;  // both wheels, before 10 degrees
  double wall_gap_m = 1e9;
  double end_s_m = kUnset, end_n_m = kUnset, end_bank_deg = kUnset;
  world::Trajectory planned;
};

StopFigures run_stop(const StopCase& stop);
std::string row_of(const StopCase& stop, const StopFigures& figures);

}  // namespace pitwall::testing
