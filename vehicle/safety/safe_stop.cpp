// SPDX-License-Identifier: Apache-2.0
#include "vehicle/safety/safe_stop.hpp"

#include <algorithm>
#include <cmath>

namespace pitwall::safety {
namespace {

using world::ActuatorCommand;
using world::Trajectory;
using world::TrajectoryPoint;

constexpr double kAdvanceMax_s = 0.1;  // a longer pause does not jump along the path

double finite_or(double value, double fallback) { return std::isfinite(value) ? value : fallback; }

// What the trajectory asks at a distance: of its first point before it, of its last behind it.
struct PlannedMotion {
  double curvature_per_m, bank_rad, accel_mps2;
};

PlannedMotion planned_at(const Trajectory& path, double s_m) {
  const auto& points = path.points;
  std::size_t i = 1;
  while (i < points.size() && points[i].s_m < s_m) ++i;
  const TrajectoryPoint& b = i < points.size() ? points[i] : points.back();
  const TrajectoryPoint& a = points[i - 1];
  const double length_m = b.s_m - a.s_m;
  const double share = length_m > 0.0 ? std::clamp((s_m - a.s_m) / length_m, 0.0, 1.0) : 0.0;
  const auto between = [share](double from, double to) { return from + share * (to - from); };
  return {finite_or(between(a.curvature_per_m, b.curvature_per_m), 0.0),
          finite_or(between(a.bank_rad, b.bank_rad), 0.0),
          finite_or(between(a.accel_mps2, b.accel_mps2), 0.0)};
}

double feedforward_rad(const SafeStopParams& params, const steering::Learned& learned,
                       double speed_mps, const PlannedMotion& w) {
  return steering::angle_rad(params.steering.bicycle, learned,
                             {speed_mps, w.curvature_per_m, w.bank_rad});
}

// `followed`: how far feedback came; not begun where there was none.
SafeStopState begin(const SafeStopParams& params, const SafeStopInputs& in,
                    const FollowingState& followed, Instant now) {
  SafeStopState s;
  s.active = true;
  s.begun = s.last = now;
  const double last_good_rad = finite_or(in.last_good.road_wheel_rad, 0.0);
  s.brake_kpa = std::max(0.0, finite_or(in.last_good.brake_kpa, 0.0));
  s.following.lock_share = followed.lock_share;
  s.steer_offset_rad = last_good_rad;
  s.speed_mps = std::max(0.0, finite_or(in.speed_mps, 0.0));
  if (in.stop.points.empty()) return s;
  if (!std::isfinite(in.speed_mps))
    s.speed_mps = std::max(0.0, finite_or(in.stop.points[0].speed_mps, 0.0));
  s.travelled_m = std::max(0.0, (now - in.stop.at).seconds()) * s.speed_mps;
  if (followed.path_at == in.stop.at && followed.begun) s.travelled_m = followed.s_m;
  const PlannedMotion w = planned_at(in.stop, s.travelled_m);
  s.learned_rad = followed.begun ? followed.steering.trim_rad + followed.steering.unknown_rad : 0.0;
  s.steer_offset_rad =
      last_good_rad - feedforward_rad(params, in.learned, s.speed_mps, w) - s.learned_rad;
  return s;
}

void advance(const SafeStopParams& params, SafeStopState& s, double measured_mps, double dt_s) {
  const double decel_mps2 = s.brake_kpa / params.brake_kpa_per_mps2 + params.coast_mps2 +
                            params.drag_per_m * s.speed_mps * s.speed_mps;
  const double reckoned_mps = std::max(0.0, s.speed_mps - decel_mps2 * dt_s);
  s.speed_mps = std::max(0.0, finite_or(measured_mps, reckoned_mps));
  s.travelled_m += s.speed_mps * dt_s;
}

double decel_of(const SafeStopParams& params, const SafeStopInputs& in, const PlannedMotion& w) {
  if (in.kind == StopKind::kEmergency) return params.emergency_decel_mps2;
  if (in.stop.points.empty()) return params.decel_without_plan_mps2;
  return std::clamp(-w.accel_mps2, params.decel_min_mps2, params.decel_max_mps2);
}

bool has_pose(const world::EgoState& ego) {
  return (ego.validity == world::Validity::kGood ||
          ego.validity == world::Validity::kDeadReckoning) &&
         std::isfinite(ego.x_m + ego.y_m + ego.yaw_rad + ego.vx_mps + ego.vy_mps);
}

void start_following(const SafeStopInputs& in, SafeStopState& s) {
  const double lock_share = s.following.lock_share;
  s.following = {};
  s.following.lock_share = lock_share;
  s.following.command = in.last_good;
  s.following.command.road_wheel_rad = finite_or(in.last_good.road_wheel_rad, 0.0);
  s.following.command.brake_kpa = s.brake_kpa;
  s.following.command.throttle_fraction = finite_or(in.last_good.throttle_fraction, 0.0);
  s.following.learned = in.learned;
}

ActuatorCommand with_feedback(const FollowingParams& params, SafeStopState& s,
                              const SafeStopInputs& in, Instant now) {
  s.following.tyre_c = in.tyre_c;
  s.following.steered_rad = in.steered_rad;
  const PathPose pose{.x_m = in.ego.x_m,
                      .y_m = in.ego.y_m,
                      .yaw_rad = in.ego.yaw_rad,
                      .speed_mps = finite_or(in.speed_mps, std::max(in.ego.vx_mps, 0.0)),
                      .slip_mps = in.ego.vy_mps,
                      .yaw_rate_rad_per_s = in.ego.yaw_rate_rad_per_s,
                      .slip = in.slip};
  ActuatorCommand command = follow_stop(params, s.following, in.stop, pose, in.kind, now);
  s.brake_kpa = command.brake_kpa;
  s.travelled_m = s.following.s_m;
  command.gear = in.last_good.gear;
  return command;
}

ActuatorCommand open_loop(const SafeStopParams& params, SafeStopState& state,
                          const SafeStopInputs& in, double dt_s, Instant now) {
  const bool planned = !in.stop.points.empty();
  const PlannedMotion w =
      planned ? planned_at(in.stop, state.travelled_m) : PlannedMotion{0.0, 0.0, 0.0};
  const double settled = planned ? std::exp(-(now - state.begun).seconds() / params.steer_settle_s)
                                 : 1.0;  // nothing to settle to: hold
  const double angle_rad =
      (planned ? feedforward_rad(params, in.learned, state.speed_mps, w) + state.learned_rad
               : 0.0) +
      state.steer_offset_rad * settled;
  Grip grip = grip_at(params, state.speed_mps, w.curvature_per_m, w.bank_rad, in.tyre_c);
  double& lock_share = state.following.lock_share;
  grip.share = lock_share = next_lock_share(params, lock_share, in.slip, dt_s);
  if (state.speed_mps < params.standstill_mps)
    state.brake_kpa = hold_towards(params, in.kind, state.brake_kpa, dt_s);
  else
    state.brake_kpa = brake_towards(params, in.kind,
                                    {.decel_mps2 = decel_of(params, in, w),
                                     .grip = grip,
                                     .last_kpa = state.brake_kpa,
                                     .dt_s = dt_s});
  return {.at = now,
          .road_wheel_rad = angle_rad,
          .throttle_fraction = 0.0,
          .brake_kpa = state.brake_kpa,
          .gear = in.last_good.gear};
}

}  // namespace

ActuatorCommand stop_along(const FollowingParams& params, SafeStopState& state,
                           const SafeStopInputs& in, Instant now) {
  const bool located = has_pose(in.ego) && in.stop.points.size() >= 2;
  if (!state.active || (state.located && !located))
    state = begin(params.stop, in, state.following, now);
  const double dt_s = std::clamp((now - state.last).seconds(), 0.0, kAdvanceMax_s);
  state.last = now;
  advance(params.stop, state, in.speed_mps, dt_s);
  if (located && !state.located) start_following(in, state);
  state.located = located;
  return located ? with_feedback(params, state, in, now)
                 : open_loop(params.stop, state, in, dt_s, now);
}

}  // namespace pitwall::safety
