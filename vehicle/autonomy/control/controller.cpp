// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/control/controller.hpp"

#include <algorithm>
#include <cmath>

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

SpeedInputs speed_inputs(const SpeedLawParams& p, const State& state, const Inputs& in,
                         bool followed) {
  constexpr double kSameThrottle = 0.005, kSameBrake_kpa = 20.0;  // slews are rounded twice
  SpeedInputs out{
      .motion = {.speed_mps = in.ego.vx_mps, .gear = state.gear.gear, .climb_rad = in.climb_rad},
      .yaw_rate_rad_per_s = in.ego.yaw_rate_rad_per_s,
      .tyre_c = in.tyre_c,
      .shifting = in.gearbox.known && in.gearbox.shifting,
      .drives = in.drives,
      .applied = state.longitudinal};
  if (in.gearbox.known && !in.gearbox.shifting)
    out.motion.gear = std::min<std::uint8_t>(in.gearbox.gear, kGears);
  if (in.applied != nullptr) {
    out.applied = {in.applied->throttle_fraction, in.applied->brake_kpa};
    out.changed = std::abs(out.applied.throttle_fraction - state.longitudinal.throttle_fraction) >
                      kSameThrottle ||
                  std::abs(out.applied.brake_kpa - state.longitudinal.brake_kpa) > kSameBrake_kpa;
  }
  const auto here = followed ? project(in.trajectory, in.ego.x_m, in.ego.y_m) : std::nullopt;
  if (!here) return out;
  const world::TrajectoryPoint point = at(in.trajectory, *here);
  out.reference_mps = point.speed_mps;
  out.bank_rad = point.bank_rad;
  const double ahead_m = std::max(in.ego.vx_mps, 0.0) * p.accel_preview_s;
  out.planned_mps2 = at(in.trajectory, *here + ahead_m).accel_mps2;
  return out;
}

// The speed law of every controller of ours.
void drive_forward(const Params& p, State& state, const Inputs& in, Action& action, Duration dt) {
  const SpeedInputs inputs = speed_inputs(p.speed, state, in, is_followed(action.lateral));
  const SpeedOutput out = step(p.speed, p.longitudinal, state.speed, inputs, dt);
  action.longitudinal = {
      .target_speed_mps = inputs.reference_mps, .raw_command = kUnset, .next = out.next};
  action.speed = out.seen;
}

// A lap teaches once the gradient of the car is known: the law is then the one whose convergence is
// judged.
LapInputs lap_inputs(const Params& p, const Inputs& in, const OnPath& path) {
  constexpr double kCornering_mps2 = 10.0, kKnown_rad = 0.003;
  const bool known = steering::doubt_rad(p.steering.learning, p.steering.bicycle, in.learned,
                                         kCornering_mps2) < kKnown_rad;
  return {.s_m = in.line.from_s_m + path.along_m,
          .length_m = in.line.length_m,
          .speed_mps = in.ego.vx_mps,
          .lateral_m = path.in.deviation.lateral_m,
          .drives = in.drives && in.ego.validity == world::Validity::kGood &&
                    path.diagnostics.verdict == LateralVerdict::kGood,
          .teaches = known};
}

}  // namespace

Action paper_lqr(const Params& p, const LateralGains& gains, State& state, const Inputs& in,
                 Duration dt) {
  Action out;
  state.steering.begun = false;
  state.speed = {};
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
  drive_forward(p, state, in, out, dt);
  return out;
}

Action lqr_ff(const Params& p, const LateralGains& gains, State& state, const Inputs& in,
              Duration dt) {
  Action out;
  const OnPath path = on_path(p.steering, p.lateral, in.learned,
                              {state.road_wheel_rad, in.angle_max_rad}, in.ego, in.trajectory);
  const double lap_rad =
      learn_lap(p.lap, p.steering, gains.lqr_ff, state.lap, lap_inputs(p, in, path), dt);
  out.lateral = path.is_usable()
                    ? steered(path, steer_lqr(p.steering, gains.lqr_ff, in.learned, state.lqr_ff,
                                              {path.in, in.ego.vy_mps, lap_rad}, dt))
                    : path.diagnostics;
  drive_forward(p, state, in, out, dt);
  return out;
}

}  // namespace pitwall::control
