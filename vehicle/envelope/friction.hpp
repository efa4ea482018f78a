// Limits of tyres and engine on a banked road: the g-g diagram of the car at a speed.
//   frames accelerations in the plane of the road; lateral positive left
//   invariants
//          normal load n and lateral demand a of steering/road_load.hpp
//          grip                  g_max = friction * n; after the lateral demand remains
//                                r = sqrt((share g_max)^2 - a^2) / n
//          braking               limited by the axle whose tyres reach the limit first: with brake
//                                share b and load l n + h d of the front axle,
//                                  b d <= m r (l n + h d),  (1 - b) d <= m r ((1 - l) n - h d),
//                                m = longitudinal / lateral friction; and d <= r n
//          driving               accel_max, power / speed and r n; where the engine is known also
//                                its force in the gear of the speed, and the rear axle, which
//                                drives:  d <= m r ((1 - l) n + h d)
//          cold tyres            friction times the share of world/tyre_grip.hpp
//   source load transfer as in Rajamani, Vehicle Dynamics and Control, 2nd ed., sec. 4.1
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "protocol/vocabulary/units.hpp"
#include "vehicle/envelope/engine.hpp"
#include "vehicle/steering/road_load.hpp"
#include "vehicle/world/legal_range.hpp"
#include "vehicle/world/tyre_grip.hpp"

namespace pitwall::envelope {

struct FrictionParams {
  double friction = kUnset;         // tyre friction coefficient, warm
  double downforce_per_m = kUnset;  // downforce / (mass v^2)
  double drag_per_m = kUnset;       // drag / (mass v^2)
  double accel_max_mps2 = kUnset;   // whatever tyres and engine could do
  double power_w_per_kg = kUnset;   // at the wheels, without regard to gears
  double brake_max_mps2 = kUnset;   // limit of the brakes
  double brake_front = kUnset;      // brake share of the front axle
  double load_front = kUnset;       // load share of the front axle
  double load_shift = kUnset;       // height of the centre of gravity / wheelbase
  double long_friction = kUnset;    // longitudinal / lateral friction
  world::TyreGrip tyres;            // grip by temperature
  Engine engine;                    // force by gear; without one power and accel_max alone hold
};

inline constexpr auto kFrictionRanges = std::to_array<world::NamedRange<FrictionParams>>({
    {"friction", &FrictionParams::friction, 0.3, 2.5},
    {"downforce_per_m", &FrictionParams::downforce_per_m, 0.0, 0.01},
    {"drag_per_m", &FrictionParams::drag_per_m, 0.0, 0.01},
    {"accel_max_mps2", &FrictionParams::accel_max_mps2, 0.5, 15.0},
    {"power_w_per_kg", &FrictionParams::power_w_per_kg, 10.0, 1000.0},
    {"brake_max_mps2", &FrictionParams::brake_max_mps2, 1.0, 30.0},
    {"brake_front", &FrictionParams::brake_front, 0.3, 0.9},
    {"load_front", &FrictionParams::load_front, 0.3, 0.7},
    {"load_shift", &FrictionParams::load_shift, 0.0, 0.4},
    {"long_friction", &FrictionParams::long_friction, 0.3, 1.5},
});

// Parameters for tyres of this temperature; unset counts as cold.
FrictionParams on_tyres(const FrictionParams& car, double tyre_c);

using steering::RoadLoad;

double grip_mps2(const FrictionParams& car, const RoadLoad& at);
// Highest speed, at most most_mps, at which this share of the grip carries the lateral demand of a
// point of the road; 0 if none does. The speed of `at` is not used.
double carried_mps(const FrictionParams& car, const RoadLoad& at, double share, double most_mps);
// Deceleration available for braking (>= 0) with this total share of the grip (0..1]; aerodynamic
// drag, which costs no grip, adds to it. Zero if the corner uses all of it.
double brake_available_mps2(const FrictionParams& car, const RoadLoad& at, double share);
// What the driven tyres carry forward (>= 0) beside the lateral demand: of the total grip, and of
// the rear axle where the engine is known.
double traction_mps2(const FrictionParams& car, const RoadLoad& at, double share);
// Net forward acceleration after drag; may be negative at high speed.
double drive_available_mps2(const FrictionParams& car, const RoadLoad& at, double share);

}  // namespace pitwall::envelope
