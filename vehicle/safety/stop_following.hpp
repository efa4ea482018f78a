// The stop, driven along its trajectory with feedback: an open-loop replay of the steering leaves a
// track of 65 m/s within four seconds.
//   in     the stop trajectory, the pose of the car, what the actuators were told last
//   out    a command: throttle 0, the gear held; at standstill the brake is held
//   frames Map; lateral error positive where the car is left of the path, angles left positive
//   invariants
//          e' = v chi, chi' = kappa v, chi the direction of travel against the path's; the wanted
//          change of curvature places both poles at w, damping z:
//            kappa = -(w^2 e + 2 z w v chi) / v^2
//          steering = L k + K a_y of the path (stop_brake.hpp) + (L + K v^2) kappa + trim; the trim
//          begins as the difference to the last angle, so that nothing steps, and integrates what
//          stays of e. The brake follows the planned deceleration and the planned speed, kept
//          within the grip that the corner leaves (stop_brake.hpp)
//          Where a newer trajectory is given its place is looked for anew
//   errors none; begun on a trajectory without points it would be our own mistake (CHECK)
//   cost   O(points passed since the last tick); no allocation
//   source Rajamani, Vehicle Dynamics and Control, 2nd ed., eq. 3.12 (feed-forward)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <type_traits>

#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/safety/stop_brake.hpp"
#include "vehicle/world/actuator_command.hpp"
#include "vehicle/world/trajectory.hpp"

namespace pitwall::safety {

// Where the car is; speed forward and slip to the left, in the plane of the road.
struct PathPose {
  double x_m = kUnset, y_m = kUnset, yaw_rad = kUnset;
  double speed_mps = kUnset, slip_mps = 0.0;
};

struct FollowingParams {
  SafeStopParams stop;
  double bandwidth_rad_per_s = 1.8;   // w; [0.5, 4]
  double damping = 0.9;               // z; [0.5, 1.5]
  double trim_per_s = 0.6;            // [0, 2]
  double trim_max_rad = 0.03;         // [0, 0.1]
  double preview_s = 0.1;             // what the steering takes; [0, 0.5]
  double slew_rad_per_s = 0.5;        // [0.1, 2]
  double angle_max_rad = 0.2;         // [0.05, 0.4]
  double gain_speed_least_mps = 8.0;  // [2, 20]
  double speed_share_per_s = 0.8;     // of the error of the speed, as deceleration; [0, 3]
};

struct FollowingState {
  bool begun = false;
  Instant path_at{};  // when the trajectory was planned
  Instant last{};
  std::size_t segment = 0;                              // of the path, where the car is
  double s_m = 0.0, lateral_m = 0.0, course_rad = 0.0;  // along and against the path
  double bank_rad = 0.0;                                // there
  double tyre_c = kUnset;                               // the coldest; unset counts as cold
  double trim_rad = 0.0;
  world::ActuatorCommand command;  // the last
};
static_assert(std::is_trivially_copyable_v<FollowingState>);

// Where the car is on the path, from the beginning of it; to be asked before the first tick.
void locate(FollowingState& state, const world::Trajectory& path, const PathPose& pose);

// The next command; state.command is the last that the car was told.
world::ActuatorCommand follow_stop(const FollowingParams& params, FollowingState& state,
                                   const world::Trajectory& path, const PathPose& pose,
                                   Instant now);

}  // namespace pitwall::safety
