// Brake control of the safe stop: the pressure for a deceleration, ramped and limited to the grip
// that the lateral force leaves (a hard stop on a banked turn spins the car). It needs no path.
//   in     speed, curvature and banking of the road, temperature of the coldest tyre
//   out    grip, pressure
//   frames lateral positive left; bank positive where the left side is lower
//   invariants
//          friction circle a_x^2 + a_y^2 <= (share mu N / m)^2, with N / m and a_y of
//          steering/road_load.hpp, mu by the tyre temperature, and the usable share of the grip.
//          Braking may use brake_share of what the corner leaves, because the front axle locks
//          before the rear one. The deceleration by air drag, rolling resistance and engine is
//          subtracted from the demand
//          a front wheel that locks takes pressure back, and with it the steering returns;
//          over-steer takes back all but the least share
//   source Rajamani, Vehicle Dynamics and Control, 2nd ed., sec. 4.1
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/steering/path_steering.hpp"
#include "vehicle/world/legal_range.hpp"
#include "vehicle/world/tyre_grip.hpp"

namespace pitwall::safety {

struct SafeStopParams {
  steering::Params steering;
  double brake_kpa_per_mps2 = 250.0;          // pressure for 1 m/s^2
  double brake_ramp_kpa_per_s = 4000.0;       // controlled stop
  double emergency_ramp_kpa_per_s = 12000.0;  // [brake_ramp, 30000]
  double brake_max_kpa = 5500.0;
  double hold_kpa = 1500.0;                  // at standstill
  double decel_min_mps2 = 2.0;               // minimum in open loop, and where the plan has stopped
  double decel_max_mps2 = 8.0;               // controlled stop; [decel_min, 15]
  double decel_without_plan_mps2 = 4.0;      // [decel_min, decel_max]
  double emergency_decel_mps2 = 14.0;        // [decel_max, 25]
  double friction = 1.0;                     // assumed in a stop with warm tyres; low on purpose
  double brake_share = 0.65;                 // of the grip at which the front axle locks
  double downforce_per_m = 0.0013;           // lift / mass per v^2
  double grip_share = 0.7;                   // usable share of the total grip; (0, 1]
  double emergency_grip_share = 0.9;         // [grip_share, 1]
  double steer_settle_s = 0.8;               // decay time of the offset from the feed-forward
  double motor_fault_bandwidth_share = 0.5;  // if the motor does not follow
  double standstill_mps = 0.3;
  double speed_share_per_s = 0.8;     // deceleration per speed error
  double brake_preview_s = 0.15;      // delay of the brakes
  double throttle_fall_per_s = 1.2;   // closing rate of the throttle
  double hold_ramp_kpa_per_s = 1500;  // at standstill
  double drag_per_m = 0.0;            // drag / (mass v^2)
  double coast_mps2 = 0.0;            // rolling and engine, throttle closed
  world::TyreGrip tyres;              // grip by temperature; same as in planning
  double lock_slip = 0.15;            // a front wheel that slips more is locking
  double lock_release_per_s = 1.5;    // fall of the brake share while it does
  double lock_recover_per_s = 0.1;    // rise afterwards
  double lock_share_least = 0.5;      // whatever the wheels report; (0, 1]
};

inline constexpr auto kSafeStopRanges = std::to_array<world::NamedRange<SafeStopParams>>({
    {"brake_kpa_per_mps2", &SafeStopParams::brake_kpa_per_mps2, 50.0, 1000.0},
    {"brake_ramp_kpa_per_s", &SafeStopParams::brake_ramp_kpa_per_s, 500.0, 20000.0},
    {"brake_max_kpa", &SafeStopParams::brake_max_kpa, 1000.0, 8191.0},
    {"hold_kpa", &SafeStopParams::hold_kpa, 300.0, 4000.0},
    {"decel_min_mps2", &SafeStopParams::decel_min_mps2, 0.5, 5.0},
    {"friction", &SafeStopParams::friction, 0.3, 2.0},
    {"brake_share", &SafeStopParams::brake_share, 0.3, 1.0},
    {"coast_mps2", &SafeStopParams::coast_mps2, 0.0, 3.0},
    {"grip_share", &SafeStopParams::grip_share, 0.05, 1.0},
    {"steer_settle_s", &SafeStopParams::steer_settle_s, 0.1, 5.0},
    {"motor_fault_bandwidth_share", &SafeStopParams::motor_fault_bandwidth_share, 0.1, 1.0},
    {"standstill_mps", &SafeStopParams::standstill_mps, 0.1, 1.0},
    {"speed_share_per_s", &SafeStopParams::speed_share_per_s, 0.0, 3.0},
    {"brake_preview_s", &SafeStopParams::brake_preview_s, 0.0, 0.5},
    {"throttle_fall_per_s", &SafeStopParams::throttle_fall_per_s, 0.2, 20.0},
    {"hold_ramp_kpa_per_s", &SafeStopParams::hold_ramp_kpa_per_s, 100.0, 20000.0},
    {"lock_slip", &SafeStopParams::lock_slip, 0.05, 0.5},
    {"lock_release_per_s", &SafeStopParams::lock_release_per_s, 0.0, 10.0},
    {"lock_recover_per_s", &SafeStopParams::lock_recover_per_s, 0.0, 1.0},
    {"lock_share_least", &SafeStopParams::lock_share_least, 0.1, 1.0},
});

enum class StopKind : std::uint8_t { kControlled, kEmergency };

// Grip of the tyres as an acceleration in the plane of the road, and the lateral part in use.
struct Grip {
  double total_mps2 = kUnset, lateral_mps2 = kUnset;
  double free_mps2 = 0.0;  // deceleration without the brake
  double share = 1.0;      // of the brake force, after wheels that locked
};
// tyre_c: coldest tyre; unset counts as cold.
Grip grip_at(const SafeStopParams& params, double speed_mps, double curvature_per_m,
             double bank_rad, double tyre_c = kUnset);

// Pressure for a deceleration by the brake alone, limited by the grip and the maximum.
double brake_for(const SafeStopParams& params, StopKind kind, double decel_mps2, const Grip& grip);

// Next pressure towards a total deceleration, limited by ramp, grip and maximum. The target is zero
// where the corner leaves no grip.
struct BrakeDemand {
  double decel_mps2 = kUnset;
  Grip grip;
  double last_kpa = kUnset, dt_s = kUnset;
};
double brake_towards(const SafeStopParams& params, StopKind kind, const BrakeDemand& demand);

// What takes brake pressure back; oversteer.hpp.
struct WheelSlip {
  double front = kUnset;
  bool oversteers = false;
};

// Next share of the brake pressure that wheels without lock-up allow: over-steer leaves the least
// share at once. It recovers while the slip is unknown.
double next_lock_share(const SafeStopParams& params, double share, const WheelSlip& slip,
                       double dt_s);

// Next pressure towards the one that holds the car at standstill, within the ramp.
double hold_towards(const SafeStopParams& params, StopKind kind, double last_kpa, double dt_s);

}  // namespace pitwall::safety
