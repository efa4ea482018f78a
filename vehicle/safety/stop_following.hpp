// The stop, driven along its trajectory with feedback: whoever stops the car (a controlled stop, an
// emergency, the guardian) drives it by this law, and by nothing else.
//   in     the stop trajectory, the pose of the car, what the actuators were told last, what was
//          learned of the car's steering, the coldest tyre
//   out    a command: throttle closing, the gear held; at standstill the brake is held
//   frames Map; lateral error positive where the car is left of the path, angles left positive
//   invariants
//          steering: steering/path_steering.hpp, within what the frame gate lets pass at the speed.
//            Where the motor does not follow, the bandwidth is strayed_bandwidth_share of it, and
//            what the wheels did is what the motor says: a motor with a limited rate that is asked
//            for more makes the car swing
//          brake: pressure = (decel - free) * kpa_per_mps2, free what air, rolling and engine do,
//            decel = -a* + speed_share (v - v*), a* and v* planned, a* a moment ahead; an emergency
//            asks for emergency_decel. It stays within the grip that the corner leaves
//            (stop_brake.hpp), by the friction that a stop reckons with, and within its ramp
//          Where a newer trajectory is given its place is looked for anew
//   errors none; begun on a trajectory without points it would be our own mistake (CHECK)
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

inline constexpr double kBrakeTouched_kpa = 50.0;  // with this much brake the throttle yields

// Where the car is; speed forward and slip to the left, in the plane of the road.
struct PathPose {
  double x_m = kUnset, y_m = kUnset, yaw_rad = kUnset;
  double speed_mps = kUnset, slip_mps = 0.0;
  double yaw_rate_rad_per_s = kUnset;  // about body z; unset: as the path turns
};

struct FollowingParams {
  SafeStopParams stop;
  GateParams gate;               // what it will have to pass
  double steering_ratio = 19.5;  // motor angle : road-wheel angle
  double slew_rad_per_s = 0.5;   // [0.1, 2]
};

struct FollowingState {
  bool begun = false;
  Instant path_at{};  // when the trajectory was planned
  Instant last{};
  std::size_t segment = 0;                              // of the path, where the car is
  double s_m = 0.0, lateral_m = 0.0, course_rad = 0.0;  // along and against the path
  double heading_rad = 0.0;                             // the yaw against it
  double curvature_per_m = 0.0, bank_rad = 0.0;         // of the path there
  double speed_mps = kUnset;                            // planned there
  double tyre_c = kUnset;                               // the coldest; unset counts as cold
  double steered_rad = kUnset;  // where the motor does not follow: what it did; else unset
  steering::Learned learned;    // of the car, before the stop
  steering::State steering;
  world::ActuatorCommand command;  // the last
};
static_assert(std::is_trivially_copyable_v<FollowingState>);

// Where the car is on the path, from the beginning of it; to be asked before the first tick.
void locate(FollowingState& state, const world::Trajectory& path, const PathPose& pose);

// The largest road-wheel angle that the gate lets pass in a stop, less a step of the field.
double stop_angle_max_rad(const GateParams& gate, double steering_ratio, double speed_mps);

// The next command; state.command is the last that the car was told.
world::ActuatorCommand follow_stop(const FollowingParams& params, FollowingState& state,
                                   const world::Trajectory& path, const PathPose& pose,
                                   StopKind kind, Instant now);

}  // namespace pitwall::safety
