// The stop of last resort: follows the last stop trajectory without planning or control. While the
// car knows where it is, with feedback (stop_following.hpp). Without, open loop in space: the
// steering angle that was good last, changed by what the curvature of the trajectory changes along
// the distance travelled; the brake along the planned deceleration, ramped, and kept within the
// grip (stop_brake.hpp). Throttle 0, the gear is held, at standstill the brake is held.
//   in     the last stop trajectory, the last good command, the car's speed by its wheels (unset:
//          dead reckoning with the deceleration that the pressure gives), where it is, its tyres
//   out    a command every tick
//   frames road-wheel angle and curvature left positive; bank positive where the left side is lower
//   errors a trajectory without points: the steering angle is held and decel_without_plan is used
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
  Instant last{};                 // of the previous tick
  double travelled_m = 0.0;       // along the trajectory, since its first point
  double speed_mps = 0.0;         // measured or dead reckoned
  double steer_offset_rad = 0.0;  // last good angle minus feed-forward, at the start
  double learned_rad = 0.0;       // what feedback had found before it ended
  double brake_kpa = 0.0;
  Instant begun{};
  bool located = false;      // in the last tick
  FollowingState following;  // while located
};
static_assert(std::is_trivially_copyable_v<SafeStopState>);

struct SafeStopInputs {
  const world::Trajectory& stop;            // the last one
  const world::ActuatorCommand& last_good;  // what the car did last: steering, brake, gear
  double speed_mps = kUnset;                // by the wheels
  StopKind kind = StopKind::kControlled;
  world::EgoState ego{};   // without a valid one: open loop
  double tyre_c = kUnset;  // the coldest; unset counts as cold
  steering::Learned learned{};
  double steered_rad = kUnset;  // of a motor that does not follow: what it did
};

// The first call with an inactive state begins the stop; reset by assigning SafeStopState{}.
world::ActuatorCommand stop_along(const FollowingParams& params, SafeStopState& state,
                                  const SafeStopInputs& inputs, Instant now);

}  // namespace pitwall::safety
