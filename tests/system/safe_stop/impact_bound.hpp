// Upper bound of the speed at which a car hits a wall, where no stop on the track can be promised:
// computed from the track, the modelled car and the car's file, never from a run. docs/safe_stop.md
// has the derivation.
//   in     what is lost, the car's Setup, the modelled car, the speed when it is lost
//   out    the impact with the largest speed and that with the largest part normal to the wall,
//          each over every place of the lap and every error of the curvature; speed 0: no contact
//   invariants
//          the car keeps its speed until somebody reacts; then
//            v' = -(pressure of whoever brakes, within the ellipse; air; rolling)
//          it follows k = (delta + K g sin(bank)) / (L + K v^2) of the angle that it holds, or the
//          line's curvature where it is steered without reference; both times 1 +- kCurvatureError,
//          and a step of the motor beside it; no more than the tyres carry
//          nothing that helps is counted: no engine brake, no scrubbing of tyres
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
  kReference,  // no receiver and no inertial unit: steered by map and distance; brakes likewise
  kComputer    // car process and guardian dead: the drive-by-wire holds the angle and brakes
};
const char* text_of(Loss loss);

// Our structure, the other one, and the first in the set-up that understeers: plant files.
inline constexpr std::array kRacingCars{"av21", "av21_compliant", "av21_putnam"};
inline constexpr double kRacing_mps = 65.7;  // 147 mph

// Of the curvature that is driven to the one that is meant, while the car brakes: the load moves to
// the front and the tyres share their grip.
inline constexpr double kCurvatureError = 0.10;

struct Impact {
  double speed_mps = 0.0, normal_mps = 0.0;
  double from_s_m = kUnset, after_m = 0.0, after_s = 0.0;  // where it was lost; until the wall
  bool left = false;
};

// The part of the speed that is normal to the nearer wall; `slip_rad` of the course beside the yaw.
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
