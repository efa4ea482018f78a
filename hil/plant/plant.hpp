// Plant model of the car: a double-track AV-21 as a function from state to state. Params::structure
// selects the equations of tyre, body, steering and brakes; the following holds for all of them.
//   in     commands of the drive-by-wire to its actuators, and the road under the car
//   out    the next state; observe() returns every quantity of a state for sensors and graders
//   frames Map: x east, y north, z up, yaw from east, counter-clockwise. Body: ISO 8855 at the
//          centre of gravity; velocities, yaw rate and forces are in the plane of the road. Banking
//          is positive where the left side is lower, climb is positive uphill: roll is minus the
//          banking, pitch is minus the climb (Euler angles in the order yaw, pitch, roll). Gravity
//          acts to the left with g sin(bank) cos(climb) and backwards with g sin(climb); the
//          heading changes with (r + climb' sin(bank)) / (cos(bank) cos(climb)); the road carries
//          the weight and the force that bends the path out of its plane.
//   method classical Runge-Kutta, one step of substep_s; the discrete parts (command delay, gear
//          box, locked wheels) change between two substeps
//   wind   drag and downforce follow the speed of the air along the car; the side force is that of
//          the cross wind (the part of the car's own slip angle in still air is included in the
//          tyres)
//   low speed  the deflection of the tyres is a state (relaxation length): a spring at standstill,
//              so the car holds on a bank, does not creep and needs no division by speed. The
//              clutch slips below engine.launch_rpm: the engine is held at that speed and its
//              torque is transmitted. A gear change cuts torque for shift_s and engages with
//              matched speed.
//   errors none: a finite state stays finite for finite inputs; inputs are clamped
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "hil/plant/params.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/world/signals.hpp"
#include "vehicle/world/track_map.hpp"

namespace pitwall::plant {

using Wheels = std::array<double, world::kCorners>;  // indexed by world::Corner

struct Actuation {
  double steering_motor_rad = 0.0;                         // set point at the motor, left positive
  double throttle_fraction = 0.0;                          // 0..1
  double brake_kpa = 0.0;                                  // set point of both axles
  bool front_brake_lost = false, rear_brake_lost = false;  // no pressure in the circuit
  std::uint8_t gear = 0;  // wanted gear, 0 neutral; reached one step at a time
  bool ignition = false;  // false stops the engine
  bool starter = false;   // turns a stopped engine
};

// Road surface under the car, in directions along and across the car. Default: level, dry.
struct Surface {
  double bank_rad = 0.0, climb_rad = 0.0;
  double bank_rate_rad_per_s = 0.0, climb_rate_rad_per_s = 0.0;  // by the motion of the car
  double height_m = 0.0;  // Map z of the centre of gravity; has no effect
  double grip = 1.0;      // scales every friction coefficient
  double wind_east_mps = 0.0, wind_north_mps = 0.0;  // air over ground, where it blows to
};

// Capacity of the delay lines: every delay must be shorter than this many substeps.
inline constexpr std::size_t kDelaySlots = 640;

enum class ShiftPhase : std::uint8_t { kReady, kShiftingUp, kShiftingDown, kLockedOut };

// The continuous part of the state: only doubles, so that the integrator can treat it as a vector.
struct Motion {
  double x_m = 0.0, y_m = 0.0, yaw_rad = 0.0;  // yaw is not wrapped
  double vx_mps = 0.0, vy_mps = 0.0, yaw_rate_rad_per_s = 0.0;
  Wheels wheel_rad_per_s{};
  Wheels stretch_long_m{}, stretch_lat_m{};  // deflection of each contact patch
  // specific force to which the springs have settled
  double load_ax_mps2 = 0.0, load_ay_mps2 = 0.0;
  double steering_motor_rad = 0.0, throttle_fraction = 0.0;
  double brake_front_kpa = 0.0, brake_rear_kpa = 0.0;
  double odometer_m = 0.0;
  // Only Structure::kCompliantBrush, else zero. Roll relative to the road, left side up positive,
  // which no sensor measures; angle of the road wheels beyond that of the motor.
  double roll_rad = 0.0, roll_rate_rad_per_s = 0.0;
  double steering_flex_rad = 0.0;
};

// Trivially copyable; a copy is a snapshot.
struct State {
  Motion motion;
  std::array<bool, world::kCorners> locked{true, true, true, true};  // held by friction
  // Ring buffers of delayed commands, with a common write position.
  std::array<double, kDelaySlots> steering_delay_rad{};
  std::array<float, kDelaySlots> throttle_delay{}, brake_delay_kpa{};  // finer than the commands
  std::array<std::uint8_t, kDelaySlots> gear_delay{};
  std::uint16_t delay_next = 0;
  std::uint8_t gear = 0, target_gear = 0;
  ShiftPhase shift = ShiftPhase::kReady;
  double shift_left_s = 0.0;
  bool engine_running = false;
  double cranked_s = 0.0;
  double engine_rpm = 0.0;
  double fuel_used_kg = 0.0;  // since the start
  Wheels tyre_c{25.0, 25.0, 25.0, 25.0};
};

inline double fuel_left_kg(const Fuel& fuel, const State& state) {
  return fuel.start_kg - state.fuel_used_kg;
}
inline double mass_kg(const Params& params, const State& state) {
  return params.chassis.mass_kg - state.fuel_used_kg;
}

// All true quantities of a state, for sensors, the drive-by-wire model and graders.
struct Truth {
  double x_m = kUnset, y_m = kUnset, yaw_rad = kUnset;  // Map; yaw wrapped
  double vx_mps = kUnset, vy_mps = kUnset, yaw_rate_rad_per_s = kUnset;
  double z_m = kUnset;                           // of the centre of gravity
  double roll_rad = kUnset, pitch_rad = kUnset;  // left side up, nose down positive
  double map_vx_mps = kUnset, map_vy_mps = kUnset, map_vz_mps = kUnset;  // east, north, up
  double heading_rate_rad_per_s = kUnset;                                // of the map yaw
  double bank_rad = kUnset;
  double speed_mps = kUnset;
  std::array<double, 3> rate_rad_per_s{kUnset, kUnset, kUnset};  // body x, y, z
  // as an accelerometer measures it
  std::array<double, 3> specific_force_mps2{kUnset, kUnset, kUnset};
  Wheels wheel_speed_mps{};                        // circumferential
  Wheels load_n{}, force_long_n{}, force_lat_n{};  // of the tyres, in the wheel's frame
  Wheels slip_ratio{}, slip_angle_rad{};
  Wheels tyre_c{};
  double friction_use = kUnset;  // largest used share of the friction of a tyre, 0..1
  double steering_motor_rad = kUnset, road_wheel_rad = kUnset;
  double throttle_fraction = kUnset;
  double brake_front_kpa = kUnset, brake_rear_kpa = kUnset;
  double engine_rpm = kUnset, engine_torque_nm = kUnset;
  double fuel_kg = kUnset;  // in the tank
  bool engine_running = false;
  std::uint8_t gear = 0;
  std::uint8_t gear_shift_status = 0;  // 0 uninitialised, 1 ready, 2 locked out, 3 up, 4 down
  double odometer_m = 0.0;
};

// Position of the car on a track, and distances of its corners from the walls.
struct Road {
  Surface surface;
  double s_m = kUnset, n_m = kUnset;
  double heading_error_rad = kUnset;                           // yaw relative to the reference line
  double wall_gap_left_m = kUnset, wall_gap_right_m = kUnset;  // of the nearest corner
  bool contact = false;  // a corner is in a wall: later states are meaningless
};

// State at standstill: engine off, brakes free, tyres at working temperature.
State standing(const Params& params, double x_m, double y_m, double yaw_rad);
// State rolling straight ahead at `speed_mps` with matched wheel speeds, in `gear`, engine running.
State rolling(const Params& params, const State& at, double speed_mps, std::uint8_t gear);

// Empties the tank; the engine stops at the next substep.
void empty_tank(const Params& params, State& state);

// `dt_s` is a whole number of substeps.
State step(const Params& params, const State& state, const Actuation& actuation,
           const Surface& surface, double dt_s);

Truth observe(const Params& params, const State& state, const Surface& surface);

// `hint_s_m`: a recent station, near which the search starts. In the pit lane, the wall on its side
// is the far edge of the lane.
Road road_at(const Params& params, const world::TrackMap& track, const State& state,
             std::optional<double> hint_s_m = std::nullopt);

}  // namespace pitwall::plant
