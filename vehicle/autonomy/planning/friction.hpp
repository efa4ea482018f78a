// Limits of tyres and engine on a banked road: the gg diagram of the speed profiles.
//   frames accelerations in the plane of the road; lateral positive left
//   invariants
//          normal load n and lateral demand a of steering/road_load.hpp
//          grip                  g_max = friction * n; what a corner leaves of it is
//                                r = sqrt((share g_max)^2 - a^2) / n
//          braking               the axle whose tyres reach it first limits: with the share b of
//                                the brakes in front and the load l n + h d of the front axle,
//                                  b d <= m r (l n + h d),  (1 - b) d <= m r ((1 - l) n - h d),
//                                m the longitudinal over the lateral friction; and d <= r n
//          cold tyres            friction times the share of world/tyre_grip.hpp
//   source load transfer as in Rajamani, Vehicle Dynamics and Control, 2nd ed., sec. 4.1
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "protocol/vocabulary/units.hpp"
#include "vehicle/steering/road_load.hpp"
#include "vehicle/world/legal_range.hpp"
#include "vehicle/world/tyre_grip.hpp"

namespace pitwall::planning {

struct FrictionParams {
  double friction = kUnset;         // tyre friction coefficient, warm
  double downforce_per_m = kUnset;  // downforce / (mass v^2)
  double drag_per_m = kUnset;       // drag / (mass v^2)
  double accel_max_mps2 = kUnset;   // by traction and gearing
  double power_w_per_kg = kUnset;   // at the wheels
  double brake_max_mps2 = kUnset;   // by the brakes
  double brake_front = kUnset;      // share of the brakes in front
  double load_front = kUnset;       // share of the load in front
  double load_shift = kUnset;       // height of the centre of gravity over the wheelbase
  double long_friction = kUnset;    // longitudinal over lateral friction
  world::TyreGrip tyres;            // of the temperature
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

// The same car on tyres of that temperature; unset counts as cold.
FrictionParams on_tyres(const FrictionParams& car, double tyre_c);

using steering::RoadLoad;

double grip_mps2(const FrictionParams& car, const RoadLoad& at);
// What remains for braking (>= 0) when the share of the grip (0..1] may be used in all; aerodynamic
// drag, which costs no grip, comes on top of it. Zero where the corner takes everything.
double brake_available_mps2(const FrictionParams& car, const RoadLoad& at, double share);
// Net forward acceleration, drag already subtracted; may be negative at high speed.
double drive_available_mps2(const FrictionParams& car, const RoadLoad& at, double share);
// Highest speed at which the corner needs no more than the share of the grip, up to a ceiling.
double corner_speed_mps(const FrictionParams& car, const RoadLoad& at, double share);

}  // namespace pitwall::planning
