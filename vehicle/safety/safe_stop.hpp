// The stop of last resort: follows the last stop trajectory without localization, planning or
// control. Open loop in space: the steering angle that was good last, changed by what the curvature
// of the trajectory changes along the distance travelled; the brake along the planned deceleration,
// ramped, and kept below what the tyres have left beside the lateral force (a hard stop on a banked
// turn spins the car). Throttle 0, the gear is held, at standstill the brake is held.
//   in     the last stop trajectory, the last good command, the car's speed by its wheels (unset:
//          dead reckoning with the deceleration that the pressure gives)
//   out    a command every tick
//   frames road-wheel angle and curvature left positive; bank positive where the left side is lower
//   errors a trajectory without points: the steering angle is held and decel_without_plan is used
//   source steady-state bicycle: delta = L k + K_us a_y, Rajamani, Vehicle Dynamics and Control,
//          2nd ed., eq. 3.12; a_y = v^2 k - g sin(bank); friction circle
//          a_x^2 + a_y^2 <= (mu N / m)^2, N / m = g cos(bank) + v^2 k sin(bank) + downforce v^2
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <type_traits>

#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/world/actuator_command.hpp"
#include "vehicle/world/trajectory.hpp"

namespace pitwall::safety {

struct SafeStopParams {
  double wheelbase_m = 2.971;                 // [2.5, 3.5]
  double understeer_rad_per_mps2 = 0.0006;    // [-0.002, 0.01]
  double brake_kpa_per_mps2 = 250.0;          // pressure for 1 m/s^2; [50, 1000]
  double brake_ramp_kpa_per_s = 4000.0;       // controlled stop; [500, 20000]
  double emergency_ramp_kpa_per_s = 12000.0;  // [brake_ramp, 30000]
  double brake_max_kpa = 5500.0;              // [1000, 8191]
  double hold_kpa = 1500.0;                   // at standstill; [300, 4000]
  double decel_min_mps2 = 2.0;                // ends every stop; [0.5, 5]
  double decel_max_mps2 = 8.0;                // controlled stop; [decel_min, 15]
  double decel_without_plan_mps2 = 4.0;       // [decel_min, decel_max]
  double emergency_decel_mps2 = 14.0;         // [decel_max, 25]
  double friction = 1.3;                      // of the tyres; [0.3, 2]
  double downforce_per_m = 0.0013;            // lift / mass per v^2; [0, 0.01]
  double grip_share = 0.7;                    // of the grip left beside the lateral force; (0, 1]
  double emergency_grip_share = 0.9;          // [grip_share, 1]
  double steer_settle_s = 0.8;                // the offset from the feed-forward decays; [0.1, 5]
  double standstill_mps = 0.3;                // [0.1, 1]
};

enum class StopKind : std::uint8_t { kControlled, kEmergency };

struct SafeStopState {
  bool active = false;
  Instant last{};                 // of the previous tick
  double travelled_m = 0.0;       // along the trajectory, since its first point
  double speed_mps = 0.0;         // measured or dead reckoned
  double steer_offset_rad = 0.0;  // last good angle minus feed-forward, at the start
  double brake_kpa = 0.0;
  Instant begun{};
};
static_assert(std::is_trivially_copyable_v<SafeStopState>);

struct SafeStopInputs {
  const world::Trajectory& stop;            // the last one
  const world::ActuatorCommand& last_good;  // what the car did last: steering, brake, gear
  double speed_mps = kUnset;                // by the wheels
  StopKind kind = StopKind::kControlled;
};

// The first call with an inactive state begins the stop; reset by assigning SafeStopState{}.
world::ActuatorCommand stop_along(const SafeStopParams& params, SafeStopState& state,
                                  const SafeStopInputs& inputs, Instant now);

// The grip of the tyres as an acceleration in the plane of the road, and the lateral part in use.
struct Grip {
  double total_mps2 = kUnset, lateral_mps2 = kUnset;
};
Grip grip_at(const SafeStopParams& params, double speed_mps, double curvature_per_m,
             double bank_rad);

// The pressure for a deceleration, within grip and maximum.
double brake_for(const SafeStopParams& params, StopKind kind, double decel_mps2, const Grip& grip);

// The brake alone: the next pressure towards a deceleration, within ramp, grip and maximum. Never
// aims below decel_min: every stop ends. Used to add the emergency brake to a command whose
// steering is still good.
struct BrakeDemand {
  double decel_mps2 = kUnset;
  Grip grip;
  double last_kpa = kUnset, dt_s = kUnset;
};
double brake_towards(const SafeStopParams& params, StopKind kind, const BrakeDemand& demand);

}  // namespace pitwall::safety
