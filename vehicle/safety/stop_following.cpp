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
constexpr double kStill_mps = 1.0;   // below, a course means nothing

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

double feedforward_rad(const SafeStopParams& p, double speed_mps, const PathPoint& at) {
  const Grip grip = grip_at(p, speed_mps, at.curvature_per_m, at.bank_rad);
  return p.wheelbase_m * at.curvature_per_m + p.understeer_rad_per_mps2 * grip.lateral_mps2;
}

// What one unit of curvature takes at the wheel.
double angle_per_curvature_m(const SafeStopParams& p, double speed_mps) {
  return p.wheelbase_m + p.understeer_rad_per_mps2 * speed_mps * speed_mps;
}

double feedback_rad(const FollowingParams& p, const FollowingState& s, double speed_mps) {
  const double v_mps = std::max(speed_mps, p.gain_speed_least_mps), w = p.bandwidth_rad_per_s;
  const double kappa_per_m =
      -(w * w * s.lateral_m + 2.0 * p.damping * w * v_mps * s.course_rad) / (v_mps * v_mps);
  return angle_per_curvature_m(p.stop, v_mps) * kappa_per_m;
}

void trim(const FollowingParams& p, FollowingState& s, double speed_mps, double dt_s) {
  const double v_mps = std::max(speed_mps, p.gain_speed_least_mps);
  const double w = p.bandwidth_rad_per_s;
  const double per_m = angle_per_curvature_m(p.stop, v_mps) * w * w / (v_mps * v_mps);
  s.trim_rad = std::clamp(s.trim_rad - p.trim_per_s * per_m * s.lateral_m * dt_s, -p.trim_max_rad,
                          p.trim_max_rad);
}

double next_brake_kpa(const FollowingParams& p, const FollowingState& s, const PathPoint& here,
                      double speed_mps, double dt_s) {
  if (speed_mps < p.stop.standstill_mps) {
    const double step_kpa = p.stop.brake_ramp_kpa_per_s * dt_s;
    return std::clamp(p.stop.hold_kpa, s.command.brake_kpa - step_kpa,
                      s.command.brake_kpa + step_kpa);
  }
  const double wanted_mps2 = -here.accel_mps2 + p.speed_share_per_s * (speed_mps - here.speed_mps);
  return brake_towards(
      p.stop, StopKind::kControlled,
      {.decel_mps2 = std::clamp(wanted_mps2, 0.0, p.stop.decel_max_mps2),
       .grip = grip_at(p.stop, speed_mps, here.curvature_per_m, here.bank_rad, s.tyre_c),
       .last_kpa = s.command.brake_kpa,
       .dt_s = dt_s});
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
  state.lateral_m = (chord_x * dy_m - chord_y * dx_m) / chord_m + bow_m;
  state.bank_rad = a.bank_rad + share * (b.bank_rad - a.bank_rad);
  const double drift_rad =
      pose.speed_mps > kStill_mps
          ? std::atan2(pose.slip_mps * std::cos(state.bank_rad), pose.speed_mps)
          : 0.0;
  state.course_rad = wrap_pi(pose.yaw_rad + drift_rad - yaw_rad);
}

world::ActuatorCommand follow_stop(const FollowingParams& params, FollowingState& state,
                                   const Trajectory& path, const PathPose& pose, Instant now) {
  locate(state, path, pose);
  const double v_mps = pose.speed_mps;
  const PathPoint ahead = path_at(path, state.segment, state.s_m + v_mps * params.preview_s);
  const double known_rad =
      feedforward_rad(params.stop, v_mps, ahead) + feedback_rad(params, state, v_mps);
  if (!state.begun) {
    state.begun = true;
    state.last = now;
    state.trim_rad = std::clamp(state.command.road_wheel_rad - known_rad, -params.trim_max_rad,
                                params.trim_max_rad);
  }
  const double dt_s = std::clamp((now - state.last).seconds(), 0.0, kTickMax_s);
  state.last = now;
  world::ActuatorCommand& command = state.command;
  if (v_mps > kStill_mps) {  // below, the wheels stay: they would turn on the spot
    trim(params, state, v_mps, dt_s);
    const double slew_rad = params.slew_rad_per_s * dt_s;
    const double wanted_rad =
        std::clamp(known_rad + state.trim_rad, -params.angle_max_rad, params.angle_max_rad);
    command.road_wheel_rad = std::clamp(wanted_rad, command.road_wheel_rad - slew_rad,
                                        command.road_wheel_rad + slew_rad);
  }
  const PathPoint here = path_at(path, state.segment, state.s_m);
  command.brake_kpa = next_brake_kpa(params, state, here, v_mps, dt_s);
  command.throttle_fraction = 0.0;
  command.at = now;
  return command;
}

}  // namespace pitwall::safety
