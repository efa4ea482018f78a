// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/tracking/prediction.hpp"

#include <cmath>

#include "vehicle/autonomy/tracking/filter/motion.hpp"
#include "vehicle/autonomy/tracking/filter/road_filter.hpp"

namespace pitwall::tracking {
namespace {

bool has_states(const world::Opponent& car) {
  for (const double v :
       {car.x_m, car.y_m, car.yaw_rad, car.speed_mps, car.accel_mps2, car.yaw_rate_rad_per_s})
    if (!std::isfinite(v)) return false;
  for (const double v : car.covariance)
    if (!std::isfinite(v)) return false;
  return true;
}

// Rows of the first states by x, y, yaw and speed: the inverse of what is published.
std::array<std::array<double, 4>, 4> by_place(const world::TrackPoint& line, double n_m) {
  const double c = std::cos(line.yaw_rad), s = std::sin(line.yaw_rad);
  const double left = 1.0 - line.curvature_per_m * n_m;
  return {{{c / left, s / left, 0.0, 0.0},
           {-s, c, 0.0, 0.0},
           {-line.curvature_per_m * c / left, -line.curvature_per_m * s / left, 1.0, 0.0},
           {0.0, 0.0, 0.0, 1.0}}};
}

void set_covariance(const world::Opponent& car, const world::TrackPoint& line, double n_m,
                    StateMatrix& p) {
  const auto rows = by_place(line, n_m);
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      for (std::size_t k = 0; k < 4; ++k)
        for (std::size_t l = 0; l < 4; ++l)
          p[i][j] += rows[i][k] * car.covariance[4 * k + l] * rows[j][l];
}

Track track_of(const RoadParams& params, const world::Opponent& car, const world::TrackMap* map) {
  Track track;
  world::TrackPoint line{.yaw_rad = 0.0, .curvature_per_m = 0.0};
  track.x = {car.x_m, car.y_m, car.yaw_rad, car.speed_mps, car.accel_mps2, car.yaw_rate_rad_per_s};
  if (map != nullptr) {
    const bool near = std::isfinite(car.s_m);
    const world::Curvilinear c =
        near ? map->project(car.x_m, car.y_m, car.s_m) : map->project(car.x_m, car.y_m);
    line = map->at(c.s_m);
    track.x[kAlong] = c.s_m, track.x[kAcross] = c.n_m;
    track.x[kHeading] = wrap_pi(car.yaw_rad - line.yaw_rad);
    track.x[kTurn] -= road_turn_of(line.curvature_per_m, track.x);
  }
  set_covariance(car, line, map != nullptr ? track.x[kAcross] : 0.0, track.p);
  const double turn_sigma =
      map != nullptr ? params.turn_sigma_rad_per_s : params.plane_turn_sigma_rad_per_s;
  track.p[kAccel][kAccel] = params.accel_sigma_mps2 * params.accel_sigma_mps2;
  track.p[kTurn][kTurn] = turn_sigma * turn_sigma;
  begin_modes(params, track);
  return track;
}

}  // namespace

std::optional<world::Opponent> predict(const Params& params, const world::Opponent& car,
                                       const world::TrackMap* track, Duration ahead) {
  if (ahead < Duration{} || ahead > from_seconds(params.coast_s) || !has_states(car))
    return std::nullopt;
  Track moved = track_of(params.road, car, track);
  coast(params.road, track, ahead, moved);
  const world::Opponent there = road_opponent(track, moved);
  world::Opponent out = car;
  out.x_m = there.x_m, out.y_m = there.y_m, out.yaw_rad = there.yaw_rad;
  out.speed_mps = there.speed_mps, out.accel_mps2 = there.accel_mps2;
  out.yaw_rate_rad_per_s = there.yaw_rate_rad_per_s;
  out.s_m = there.s_m, out.n_m = there.n_m;
  out.covariance = there.covariance;
  return out;
}

}  // namespace pitwall::tracking
