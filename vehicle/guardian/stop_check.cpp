// SPDX-License-Identifier: Apache-2.0
#include "vehicle/guardian/stop_check.hpp"

#include <cmath>
#include <optional>

namespace pitwall::guardian {
namespace {

using world::TrajectoryPoint;

constexpr std::size_t kBetweenPoints = 4;  // walls do not move within 20 m
constexpr double kStretch_m = 0.5;         // a chord may be shorter than its arc, and rounding

bool finite(const TrajectoryPoint& p) {
  return std::isfinite(p.s_m + p.x_m + p.y_m + p.yaw_rad + p.curvature_per_m + p.bank_rad +
                       p.speed_mps + p.accel_mps2);
}

bool rises(const StopCheckParams& params, const TrajectoryPoint& a, const TrajectoryPoint& b) {
  const double along_m = b.s_m - a.s_m, chord_m = std::hypot(b.x_m - a.x_m, b.y_m - a.y_m);
  return along_m > 0.0 && along_m <= params.step_max_m && std::abs(along_m - chord_m) <= kStretch_m;
}

bool begins_at(const StopCheckParams& params, const TrajectoryPoint& first,
               const world::EgoState& ego) {
  const double dx_m = ego.x_m - first.x_m, dy_m = ego.y_m - first.y_m;
  const double c = std::cos(first.yaw_rad), s = std::sin(first.yaw_rad);
  return std::abs(c * dx_m + s * dy_m) <= params.ahead_max_m &&
         std::abs(c * dy_m - s * dx_m) <= params.beside_max_m &&
         std::abs(wrap_pi(ego.yaw_rad - first.yaw_rad)) <= params.turned_max_rad &&
         std::abs(ego.vx_mps - first.speed_mps) <= params.speed_off_max_mps;
}

bool on_track(const StopCheckParams& params, const world::Trajectory& stop,
              const world::TrackMap& track) {
  std::optional<double> hint;
  for (std::size_t i = 0; i < stop.points.size(); i += kBetweenPoints) {
    const TrajectoryPoint& p = stop.points[i];
    const world::Curvilinear place = track.project(p.x_m, p.y_m, hint);
    hint = place.s_m;
    const world::TrackPoint at = track.at(place.s_m);
    if (!(at.width_left_m - place.n_m >= params.wall_least_m &&
          at.width_right_m + place.n_m >= params.wall_least_m))
      return false;
  }
  return true;
}

}  // namespace

StopVerdict check_stop(const StopCheckParams& params, const world::Trajectory& stop,
                       const world::EgoState& ego, const world::TrackMap& track) {
  const auto& points = stop.points;
  if (points.size() < 2) return StopVerdict::kEmpty;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!finite(points[i]) || points[i].speed_mps < 0.0) return StopVerdict::kNotFinite;
    if (i > 0 && !rises(params, points[i - 1], points[i])) return StopVerdict::kNotMonotone;
    if (std::abs(points[i].accel_mps2) > params.accel_max_mps2) return StopVerdict::kTooHard;
  }
  if (!begins_at(params, points[0], ego)) return StopVerdict::kNotHere;
  if (!(points.back().speed_mps <= params.standing_mps)) return StopVerdict::kNoStop;
  return on_track(params, stop, track) ? StopVerdict::kGood : StopVerdict::kOffTrack;
}

}  // namespace pitwall::guardian
