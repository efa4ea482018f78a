// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/control/feed_forward.hpp"

#include <algorithm>
#include <cmath>

#include "vehicle/autonomy/control/preview.hpp"

namespace pitwall::control {
namespace {

constexpr double kDriftFrom_mps = 5.0;  // below, the noise of the slip is not a course

using world::EgoState;
using world::TrajectoryPoint;

struct Errors {
  double lateral_m, heading_rad, course_rad;
};

Errors errors_at(const TrajectoryPoint& p, const EgoState& ego) {
  const double dx_m = ego.x_m - p.x_m, dy_m = ego.y_m - p.y_m;
  const double heading_rad = wrap_pi(ego.yaw_rad - p.yaw_rad);
  const double drift_rad =
      std::atan2(ego.vy_mps * std::cos(p.bank_rad), std::max(ego.vx_mps, kDriftFrom_mps));
  return {-dx_m * std::sin(p.yaw_rad) + dy_m * std::cos(p.yaw_rad), heading_rad,
          heading_rad + drift_rad};
}

}  // namespace

OnPath on_path(const steering::Params& params, const LateralParams& lateral,
               const steering::Learned& learned, const Angles& angles, const EgoState& ego,
               const world::Trajectory& trajectory) {
  OnPath path;
  LateralDiagnostics& out = path.diagnostics;
  out.angle_rad = angles.last_rad;
  if (!is_usable(ego)) return out.verdict = LateralVerdict::kNoEgo, path;
  const auto on_path_m = project(trajectory, ego.x_m, ego.y_m);
  if (!on_path_m) return out.verdict = LateralVerdict::kNoTrajectory, path;
  path.along_m = *on_path_m;
  const double v_mps = std::max(ego.vx_mps, 0.0);
  const TrajectoryPoint here = at(trajectory, *on_path_m);
  const auto road_at = [&](double ahead_m) -> steering::RoadPoint {
    const TrajectoryPoint p = at(trajectory, *on_path_m + ahead_m);
    return {p.curvature_per_m, p.bank_rad};
  };
  const Errors e = errors_at(here, ego);
  out.cross_track_m = out.e1_m = e.lateral_m;
  out.heading_error_rad = out.e2_rad = e.heading_rad;
  out.bracket = static_cast<std::uint8_t>(bracket_of(v_mps));
  out.verdict = std::abs(e.lateral_m) <= lateral.deviation_max_m ? LateralVerdict::kGood
                                                                 : LateralVerdict::kTooFar;
  path.in = {.deviation = {e.lateral_m, e.course_rad, here.curvature_per_m, here.bank_rad},
             .ahead = path_ahead(params, learned, v_mps, road_at),
             .speed_mps = v_mps,
             .yaw_rate_rad_per_s = ego.yaw_rate_rad_per_s,
             .last_angle_rad = angles.last_rad,
             .angle_max_rad = angle_max_rad(lateral, angles)};
  return path;
}

LateralDiagnostics steered(const OnPath& path, double angle_rad) {
  LateralDiagnostics out = path.diagnostics;
  out.angle_rad = angle_rad;
  out.saturated = std::abs(angle_rad) >= path.in.angle_max_rad;
  return out;
}

LateralDiagnostics steer_forward(const steering::Params& params, const LateralParams& lateral,
                                 const steering::Learned& learned, steering::State& state,
                                 const Angles& angles, const EgoState& ego,
                                 const world::Trajectory& trajectory, Duration dt) {
  const OnPath path = on_path(params, lateral, learned, angles, ego, trajectory);
  if (!path.is_usable()) return path.diagnostics;
  return steered(path, steering::steer(params, learned, state, path.in, dt));
}

}  // namespace pitwall::control
