// Stop controller with feedback along the stop trajectory. Every stop (controlled stop, emergency
// stop, guardian) uses this control law.
//   in     the stop trajectory, the pose of the car, the last command, the learned correction of
//          the steering, the coldest tyre
//   out    a command: throttle closing, gear held; at standstill the brake is held
//   frames Map; lateral error positive if the car is left of the path, angles left positive
//   invariants
//          steering: steering/path_steering.hpp, within the limit of the frame gate at the speed.
//          If the motor does not follow, motor_fault_bandwidth_share multiplies the bandwidth, and
//          the measured motor angle replaces the command: a rate-limited motor with a higher
//          bandwidth makes the car oscillate. Over-steer closes the throttle at once
//          brake: pressure = (decel - free) * kpa_per_mps2, with free the deceleration by air,
//          rolling and engine and decel = -a* + speed_share (v - v*). a* and v* are planned, a*
//          brake_preview_s ahead. An emergency demands emergency_decel. The pressure stays within
//          the grip that the corner leaves (stop_brake.hpp), with the friction assumed in a stop,
//          and within its ramp
//          for a newer trajectory the position along it is searched from its beginning
//   errors none; a trajectory with fewer than two points is a programming error (CHECK)
//   cost   O(points passed since the last tick); no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <type_traits>

#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/safety/frame_gate.hpp"
#include "vehicle/safety/stop_brake.hpp"
#include "vehicle/steering/path_steering.hpp"
#include "vehicle/world/actuator_command.hpp"
#include "vehicle/world/trajectory.hpp"

namespace pitwall::safety {

inline constexpr double kBrakeTouched_kpa = 50.0;  // the throttle is zero above this brake pressure

// Pose and velocity of the car: speed forward and slip to the left, in the plane of the road.
struct PathPose {
  double x_m = kUnset, y_m = kUnset, yaw_rad = kUnset;
  double speed_mps = kUnset, slip_mps = 0.0;
  double yaw_rate_rad_per_s = kUnset;  // about body z; unset: yaw rate of the path
  WheelSlip slip{};
};

struct FollowingParams {
  SafeStopParams stop;
  GateParams gate;               // limits that the commands must satisfy
  double steering_ratio = 19.5;  // motor angle : road-wheel angle
  double slew_rad_per_s = 0.5;   // [0.1, 2]
};

struct FollowingState {
  bool begun = false;
  Instant path_at{};  // planning time of the trajectory
  Instant last{};
  std::size_t segment = 0;                              // of the path, at the car
  double s_m = 0.0, lateral_m = 0.0, course_rad = 0.0;  // relative to the path
  double heading_rad = 0.0;                             // yaw relative to the path
  double curvature_per_m = 0.0, bank_rad = 0.0;         // of the path at the car
  double speed_mps = kUnset;                            // planned speed at the car
  double tyre_c = kUnset;                               // coldest tyre; unset counts as cold
  double lock_share = 1.0;                              // next_lock_share() of stop_brake.hpp
  double steered_rad = kUnset;  // measured angle if the motor does not follow; else unset
  steering::Learned learned;    // as learned before the stop
  steering::State steering;
  world::ActuatorCommand command;  // the last command
};
static_assert(std::is_trivially_copyable_v<FollowingState>);

// Locates the car on the path, searching from its last segment. To be called before the first tick.
void locate(FollowingState& state, const world::Trajectory& path, const PathPose& pose);

// Largest road-wheel angle that the gate lets pass in a stop, minus one step of the CAN field.
double stop_angle_max_rad(const GateParams& gate, double steering_ratio, double speed_mps);

// Next command. state.command must hold the last command to the car.
world::ActuatorCommand follow_stop(const FollowingParams& params, FollowingState& state,
                                   const world::Trajectory& path, const PathPose& pose,
                                   StopKind kind, Instant now);

}  // namespace pitwall::safety
