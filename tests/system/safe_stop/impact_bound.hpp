// Upper bound of the speed at which a car hits a wall after a loss for which no stop on the track
// is promised. It is computed from the track, the modelled car and the car's file, never from a
// run; docs/safe_stop.md has the derivation.
//   in     what is lost, the car's Setup, the modelled car, the speed when it is lost
//   out    the impact with the largest speed and the impact with the largest part normal to the
//          wall, each over every place of the lap (10 m apart) and every error of the curvature;
//          speed 0: no contact
//   invariants
//          the car keeps its speed until the brakes react; then
//            v' = -(brake pressure, within the friction ellipse; air; rolling resistance)
//          it follows k = (delta + K g sin(bank)) / (L + K v^2) of the held angle, or the line's
//          curvature if it is steered without reference; both times 1 +- kCurvatureError, plus one
//          step of the motor, and at most what the tyres can transmit
//          effects that help are not counted: engine brake, scrubbing of tyres
//   units  SI
//   errors none
//   source Rajamani, Vehicle Dynamics and Control, 2nd ed., eq. 3.12 (steady-state bicycle)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "hil/plant/params.hpp"
#include "hil/plant/plant.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/pipeline/setup.hpp"

namespace pitwall::testing {

enum class Loss : std::uint8_t {
  kSteering,   // the motor holds its angle; the car brakes as in an emergency
  kReference,  // no receiver and no inertial unit: steered by map and distance; the same braking
  kComputer    // car process and guardian dead: the drive-by-wire holds the angle and brakes
};
const char* text_of(Loss loss);

// Plant files: our structure, the other structure, and ours in the set-up that understeers.
inline constexpr std::array kRacingCars{"av21", "av21_compliant", "av21_putnam"};
inline constexpr double kRacing_mps = 65.7;  // 147 mph

// Relative error of the driven curvature while the car brakes: the load moves to the front and the
// tyres share their grip.
inline constexpr double kCurvatureError = 0.10;

struct Impact {
  double speed_mps = 0.0, normal_mps = 0.0;
  // Station of the loss; distance and time from there to the wall.
  double from_s_m = kUnset, after_m = 0.0, after_s = 0.0;
  bool left = false;
};

// Part of the speed normal to the nearer wall; `slip_rad` is the course minus the yaw.
double normal_mps(const world::TrackMap& track, const plant::Road& road, double speed_mps,
                  double slip_rad);

struct ImpactBound {
  Impact fastest, steepest;
};

struct ImpactCase {
  Loss loss = Loss::kSteering;
  const pipeline::Setup& setup;
  const plant::Params& plant;
  double speed_mps = kUnset;
};
ImpactBound bound_impact(const ImpactCase& of);

// The fastest that the wheels of the modelled car turn along the line, at a constant speed.
double steering_rate_rad_per_s(const ImpactCase& of);

}  // namespace pitwall::testing
