// Controllers: each is a lateral and a longitudinal law together, and the car file chooses one by
// its name. A new one is a source file and a row of kControllers; one that can fail calls another
// one as its fallback.
//   in     Params, gains, State, Inputs
//   out    Action, which is also this tick's command; State
//   invariants
//          State is a copyable value with what every controller remembers. A controller changes
//          only its own part of it
//   errors LateralDiagnostics.verdict. Without a trajectory or an ego state the angle is held, and
//          throttle and brake are released at their rates
//   cost   no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

#include "protocol/vocabulary/time.hpp"
#include "vehicle/autonomy/control/bicycle_params.hpp"
#include "vehicle/autonomy/control/gear.hpp"
#include "vehicle/autonomy/control/lap_learning.hpp"
#include "vehicle/autonomy/control/lateral.hpp"
#include "vehicle/autonomy/control/longitudinal.hpp"
#include "vehicle/autonomy/control/lqr_ff.hpp"
#include "vehicle/autonomy/control/speed_law.hpp"
#include "vehicle/steering/path_steering.hpp"
#include "vehicle/world/actuator_command.hpp"
#include "vehicle/world/ego_state.hpp"
#include "vehicle/world/trajectory.hpp"

namespace pitwall::control {

struct Params;
struct State;
struct Inputs;

struct Action {
  LateralDiagnostics lateral;
  LongitudinalOutput longitudinal;
  SpeedDiagnostics speed;  // of speed_law.hpp
};

struct Controller {
  std::string_view name;
  Action (*step)(const Params&, const LateralGains&, State&, const Inputs&, Duration dt) = nullptr;
};

struct Params {
  Controller controller;
  BicycleParams bicycle;
  LateralParams lateral;
  LqrParams lqr_ff;
  LapParams lap;
  steering::Params steering;
  LongitudinalParams longitudinal;  // rates and limits of throttle and brake; the published law
  SpeedLawParams speed;
  GearParams gear;
};

struct State {
  double road_wheel_rad = 0.0;  // last command
  LongitudinalState longitudinal;
  GearState gear;
  steering::State steering;
  SpeedLawState speed;
  LqrState lqr_ff;
  LapState lap{};
};

// Where the trajectory begins on the line that is driven lap by lap; unset: it leaves the line.
struct LinePlace {
  double from_s_m = kUnset, length_m = kUnset;
};

struct Inputs {
  const world::EgoState& ego;
  const world::Trajectory& trajectory;
  steering::Learned learned{};
  LinePlace line{};
  double angle_max_rad = kUnset;  // limit of the frame gate at this speed; unset: none
  GearReport gearbox{};
  double tyre_c = kUnset;  // coldest tyre; unset counts as cold
  double climb_rad = 0.0;  // of the road, along the path
  bool drives = true;      // the command is sent to the car, if no other module changes it
  const world::ActuatorCommand* applied = nullptr;  // in the last tick; null: the last command
};

// The published controller: lateral.hpp and longitudinal.hpp.
Action paper_lqr(const Params& params, const LateralGains& gains, State& state,
                 const Inputs& inputs, Duration dt);
// Steering by feed_forward.hpp, speed by speed_law.hpp.
Action feed_forward(const Params& params, const LateralGains& gains, State& state,
                    const Inputs& inputs, Duration dt);
// Steering by lqr_ff.hpp and lap_learning.hpp, speed by speed_law.hpp.
Action lqr_ff(const Params& params, const LateralGains& gains, State& state, const Inputs& inputs,
              Duration dt);

inline constexpr std::array kControllers{
    Controller{"paper_lqr", paper_lqr},
    Controller{"feed_forward", feed_forward},
    Controller{"lqr_ff", lqr_ff},
};

// Without a step if there is none of this name.
constexpr Controller controller_named(std::string_view name) {
  for (const Controller& c : kControllers)
    if (c.name == name) return c;
  return {};
}

}  // namespace pitwall::control
