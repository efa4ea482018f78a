// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/control/controller.hpp"

#include <algorithm>

#include "vehicle/autonomy/control/feed_forward.hpp"
#include "vehicle/autonomy/control/preview.hpp"

namespace pitwall::control {
namespace {

bool is_followed(const LateralDiagnostics& lateral) {
  return lateral.verdict == LateralVerdict::kGood || lateral.verdict == LateralVerdict::kTooFar;
}

double target_speed(const LongitudinalParams& p, const world::EgoState& ego,
                    const world::Trajectory& trajectory) {
  const auto here = project(trajectory, ego.x_m, ego.y_m);
  if (!here) return kUnset;
  return at(trajectory, *here + std::max(ego.vx_mps, 0.0) * p.speed_preview_s).speed_mps;
}

LongitudinalOutput drive(const Params& p, const State& state, const Inputs& in, bool followed,
                         Duration dt) {
  const double target = followed ? target_speed(p.longitudinal, in.ego, in.trajectory) : kUnset;
  return step(p.longitudinal, state.longitudinal, target, in.ego.vx_mps, dt);
}

}  // namespace

Action paper_lqr(const Params& p, const LateralGains& gains, State& state, const Inputs& in,
                 Duration dt) {
  Action out;
  state.steering.begun = false;
  out.lateral =
      steer(p.lateral, gains, {state.road_wheel_rad, in.angle_max_rad}, in.ego, in.trajectory);
  out.longitudinal = drive(p, state, in, is_followed(out.lateral), dt);
  return out;
}

Action feed_forward(const Params& p, const LateralGains&, State& state, const Inputs& in,
                    Duration dt) {
  Action out;
  out.lateral = steer_forward(p.steering, p.lateral, in.learned, state.steering,
                              {state.road_wheel_rad, in.angle_max_rad}, in.ego, in.trajectory, dt);
  out.longitudinal = drive(p, state, in, is_followed(out.lateral), dt);
  return out;
}

}  // namespace pitwall::control
