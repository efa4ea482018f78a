// Safe stop: follows the last stop trajectory without planning or control. While the position is
// known it uses feedback (stop_following.hpp). Otherwise it runs open loop over the distance
// travelled: the steering is the feed-forward of the trajectory plus the offset of the last good
// angle, which decays over steer_settle_s; the brake follows the planned deceleration, ramped and
// within the grip (stop_brake.hpp); the throttle is zero. The gear is held; at standstill the brake
// is held.
//   in     the last stop trajectory, the last good command, the speed from the wheels (unset: dead
//          reckoning with the deceleration that the brake pressure gives), the ego state, tyre
//          temperature
//   out    a command in every tick
//   frames road-wheel angle and curvature left positive; bank positive where the left side is lower
//   errors for a trajectory without points the steering angle is held and decel_without_plan is
//          used
//   source steady-state bicycle of steering/path_steering.hpp
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <type_traits>

#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/safety/stop_brake.hpp"
#include "vehicle/safety/stop_following.hpp"
#include "vehicle/world/actuator_command.hpp"
#include "vehicle/world/ego_state.hpp"
#include "vehicle/world/trajectory.hpp"

namespace pitwall::safety {

struct SafeStopState {
  bool active = false;
  Instant last{};                 // previous tick
  double travelled_m = 0.0;       // along the trajectory, from its first point
  double speed_mps = 0.0;         // measured or dead reckoned
  double steer_offset_rad = 0.0;  // at the start: last good angle minus feed-forward
  double learned_rad = 0.0;       // trim and observer of the feedback when it ended
  double brake_kpa = 0.0;
  Instant begun{};
  bool located = false;      // position known in the last tick
  FollowingState following;  // while located; its lock_share always
};
static_assert(std::is_trivially_copyable_v<SafeStopState>);

struct SafeStopInputs {
  const world::Trajectory& stop;            // the newest
  const world::ActuatorCommand& last_good;  // steering, brake, gear
  double speed_mps = kUnset;                // from the wheels
  StopKind kind = StopKind::kControlled;
  world::EgoState ego{};   // if not valid: open loop
  double tyre_c = kUnset;  // coldest tyre; unset counts as cold
  WheelSlip slip{};
  steering::Learned learned{};
  double steered_rad = kUnset;  // measured angle if the motor does not follow; else unset
};

// The first call with an inactive state begins the stop; reset by assigning SafeStopState{}.
world::ActuatorCommand stop_along(const FollowingParams& params, SafeStopState& state,
                                  const SafeStopInputs& inputs, Instant now);

}  // namespace pitwall::safety
