// SPDX-License-Identifier: Apache-2.0
#include "vehicle/safety/stop_following.hpp"

#include <algorithm>
#include <cmath>

#include "protocol/vocabulary/check.hpp"

namespace pitwall::safety {
namespace {

using world::Trajectory;
using world::TrajectoryPoint;

constexpr double kTickMax_s = 0.05;  // a longer pause opens no slew limit
constexpr double kPlannedStill_mps = 0.05;
constexpr double kFirstTick_s = 0.01;
constexpr double kStill_mps = 1.0;  // below, a course means nothing

struct PathPoint {
  double curvature_per_m, bank_rad, speed_mps, accel_mps2;
};

PathPoint path_at(const Trajectory& path, std::size_t segment, double s_m) {
  const auto& points = path.points;
  while (segment + 2 < points.size() && points[segment + 1].s_m < s_m) ++segment;
  const TrajectoryPoint &a = points[segment], &b = points[segment + 1];
  const double share = std::clamp((s_m - a.s_m) / (b.s_m - a.s_m), 0.0, 1.0);
  const auto between = [share](double from, double to) { return from + share * (to - from); };
  return {between(a.curvature_per_m, b.curvature_per_m), between(a.bank_rad, b.bank_rad),
          between(a.speed_mps, b.speed_mps), between(a.accel_mps2, b.accel_mps2)};
}

double next_brake_kpa(const SafeStopParams& p, const FollowingState& s, const PathPoint& here,
                      const PathPoint& ahead, double speed_mps, StopKind kind, double dt_s) {
  const double last_kpa = s.command.brake_kpa;
  const bool ends = here.speed_mps < kPlannedStill_mps && speed_mps < kStill_mps;
  if (ends || speed_mps < p.standstill_mps) return hold_towards(p, kind, last_kpa, dt_s);
  Grip grip = grip_at(p, speed_mps, here.curvature_per_m, here.bank_rad, s.tyre_c);
  grip.share = s.lock_share;
  if (kind == StopKind::kEmergency)
    return brake_towards(p, kind, {p.emergency_decel_mps2, grip, last_kpa, dt_s});
  // Where the plan stands the car is to stand, whatever pushes it.
  const double least_mps2 = here.speed_mps < kPlannedStill_mps ? p.decel_min_mps2 : 0.0;
  const double wanted_mps2 =
      std::clamp(-ahead.accel_mps2 + p.speed_share_per_s * (speed_mps - here.speed_mps), least_mps2,
                 p.decel_max_mps2);
  return brake_towards(p, kind, {wanted_mps2, grip, last_kpa, dt_s});
}

// A pressure that is more than the gate lets a controlled stop have comes down from the first tick
// on; repeated it would be refused.
double begin_within_gate_kpa(const FollowingParams& p, double last_kpa, double speed_mps) {
  const double step_kpa = p.stop.emergency_ramp_kpa_per_s * kFirstTick_s;
  return std::min(last_kpa, std::max(stop_brake_limit_kpa(p.gate, speed_mps), last_kpa - step_kpa));
}

// The throttle closes, and yields to the brake and to over-steer at once.
double next_throttle(const SafeStopParams& p, double last, double brake_kpa, bool oversteers,
                     double dt_s) {
  if (oversteers || brake_kpa > kBrakeTouched_kpa) return 0.0;
  return std::clamp(last - p.throttle_fall_per_s * dt_s, 0.0, 1.0);
}

}  // namespace

void locate(FollowingState& state, const Trajectory& path, const PathPose& pose) {
  const auto& points = path.points;
  CHECK(points.size() >= 2);
  if (path.at != state.path_at) state.segment = 0;
  state.path_at = path.at;
  const auto ahead_m = [&](const TrajectoryPoint& p) {
    return std::cos(p.yaw_rad) * (pose.x_m - p.x_m) + std::sin(p.yaw_rad) * (pose.y_m - p.y_m);
  };
  while (state.segment + 2 < points.size() && ahead_m(points[state.segment + 1]) > 0.0)
    ++state.segment;
  const TrajectoryPoint &a = points[state.segment], &b = points[state.segment + 1];
  const double length_m = b.s_m - a.s_m;
  const double share = std::clamp(ahead_m(a) / length_m, 0.0, 1.0);
  const double yaw_rad = a.yaw_rad + share * wrap_pi(b.yaw_rad - a.yaw_rad);
  // The path between two points is an arc: its sagitta stands out of the chord to the right.
  const double bow_m = 0.5 * (a.curvature_per_m + b.curvature_per_m) * 0.5 * share * (1.0 - share) *
                       length_m * length_m;
  const double chord_x = b.x_m - a.x_m, chord_y = b.y_m - a.y_m;
  const double chord_m = std::hypot(chord_x, chord_y);
  const double dx_m = pose.x_m - a.x_m, dy_m = pose.y_m - a.y_m;
  state.s_m = a.s_m + share * length_m;
  state.curvature_per_m = a.curvature_per_m + share * (b.curvature_per_m - a.curvature_per_m);
  state.speed_mps = a.speed_mps + share * (b.speed_mps - a.speed_mps);
  state.lateral_m = (chord_x * dy_m - chord_y * dx_m) / chord_m + bow_m;
  state.bank_rad = a.bank_rad + share * (b.bank_rad - a.bank_rad);
  const double drift_rad =
      pose.speed_mps > kStill_mps
          ? std::atan2(pose.slip_mps * std::cos(state.bank_rad), pose.speed_mps)
          : 0.0;
  state.heading_rad = wrap_pi(pose.yaw_rad - yaw_rad);
  state.course_rad = wrap_pi(pose.yaw_rad + drift_rad - yaw_rad);
}

double stop_angle_max_rad(const GateParams& gate, double steering_ratio, double speed_mps) {
  constexpr double kStep_deg = 1.0;
  const double limit_deg = gate.stop_steer_share * steer_limit_deg(gate, speed_mps) - kStep_deg;
  return from_deg(limit_deg) / steering_ratio;
}

world::ActuatorCommand follow_stop(const FollowingParams& params, FollowingState& state,
                                   const Trajectory& path, const PathPose& pose, StopKind kind,
                                   Instant now) {
  locate(state, path, pose);
  const SafeStopParams& p = params.stop;
  const double v_mps = pose.speed_mps;
  const bool begins = !state.begun;
  if (begins) state.begun = true, state.last = now;
  const double dt_s = std::clamp((now - state.last).seconds(), 0.0, kTickMax_s);
  state.last = now;
  world::ActuatorCommand& command = state.command;
  const bool deviates = std::isfinite(state.steered_rad);
  steering::follow_command(p.steering.learning, state.learned,
                           deviates ? state.steered_rad : command.road_wheel_rad,
                           from_seconds(dt_s));
  const auto road_at = [&](double ahead_m) -> steering::RoadPoint {
    const PathPoint point = path_at(path, state.segment, state.s_m + ahead_m);
    return {point.curvature_per_m, point.bank_rad};
  };
  const double wanted_rad = steering::steer(
      p.steering, state.learned, state.steering,
      {.deviation = {state.lateral_m, state.course_rad, state.curvature_per_m, state.bank_rad},
       .ahead = path_ahead(p.steering, state.learned, v_mps, road_at),
       .speed_mps = v_mps,
       .yaw_rate_rad_per_s = pose.yaw_rate_rad_per_s,
       .last_angle_rad = command.road_wheel_rad,
       .angle_max_rad = stop_angle_max_rad(params.gate, params.steering_ratio, v_mps),
       .bandwidth_share = deviates ? p.motor_fault_bandwidth_share : 1.0},
      from_seconds(dt_s));
  const double slew_rad = params.slew_rad_per_s * dt_s;
  command.road_wheel_rad =
      std::clamp(wanted_rad, command.road_wheel_rad - slew_rad, command.road_wheel_rad + slew_rad);
  const PathPoint here = path_at(path, state.segment, state.s_m);
  const PathPoint braked = path_at(path, state.segment, state.s_m + v_mps * p.brake_preview_s);
  if (begins && kind == StopKind::kControlled)
    command.brake_kpa = begin_within_gate_kpa(params, command.brake_kpa, v_mps);
  state.lock_share = next_lock_share(p, state.lock_share, pose.slip, dt_s);
  command.brake_kpa = next_brake_kpa(p, state, here, braked, v_mps, kind, dt_s);
  command.throttle_fraction =
      next_throttle(p, command.throttle_fraction, command.brake_kpa, pose.slip.oversteers, dt_s);
  command.at = now;
  return command;
}

}  // namespace pitwall::safety
