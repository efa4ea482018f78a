// Round track with cars on it, and what sensors of our own car would measure of them. The truth is
// closed form, by no function of the tracker or of TrackMap.
//   frames Map: the track passes (0, 0) towards +x, its centre is at (0, radius)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <numbers>
#include <random>

#include "protocol/vocabulary/check.hpp"
#include "tests/support/draw.hpp"
#include "vehicle/autonomy/tracking/filter/frame.hpp"
#include "vehicle/world/detection.hpp"
#include "vehicle/world/track_map.hpp"

namespace pitwall::tracking::testing {

inline constexpr double kRadius_m = 250.0, kHalfWidth_m = 10.0;

inline world::TrackMap circle() {
  world::TrackDescription d;
  d.name = "circle";
  d.length_m = 2.0 * std::numbers::pi * kRadius_m;
  d.datum_latitude_deg = 36.27, d.datum_longitude_deg = -115.01, d.datum_height_m = 594.0;
  for (int i = 0; i < 4; ++i)
    d.knots.push_back({0.25 * i * d.length_m, 1.0 / kRadius_m, 0.0, kHalfWidth_m, kHalfWidth_m});
  auto map = world::TrackMap::build(d);
  CHECK(map.has_value());
  return *std::move(map);
}

struct TruePose {
  double x_m, y_m, yaw_rad, speed_mps;
};

// At a station and offset, with a heading relative to the track.
inline TruePose on_circle(double s_m, double n_m, double heading_rad, double speed_mps) {
  const double turned_rad = s_m / kRadius_m, r_m = kRadius_m - n_m;
  return {r_m * std::sin(turned_rad), kRadius_m - r_m * std::cos(turned_rad),
          wrap_pi(turned_rad + heading_rad), speed_mps};
}

// A car that keeps its offset and changes its speed as a sine.
struct Car {
  double s_m = 0.0, n_m = 0.0, speed_mps = 60.0;
  double swing_mps = 0.0, swing_rad_per_s = 0.5;

  TruePose at(double t_s) const {
    const double left = 1.0 - n_m / kRadius_m;
    const double phase = swing_rad_per_s * t_s;
    const double way_m = speed_mps * t_s + swing_mps / swing_rad_per_s * (1.0 - std::cos(phase));
    return on_circle(s_m + way_m / left, n_m, 0.0, speed_mps + swing_mps * std::sin(phase));
  }
};

inline OwnMotion own_motion(const TruePose& p) {
  return {.x_m = p.x_m,
          .y_m = p.y_m,
          .yaw_rad = p.yaw_rad,
          .vx_mps = p.speed_mps * std::cos(p.yaw_rad),
          .vy_mps = p.speed_mps * std::sin(p.yaw_rad),
          .s_m = std::remainder(std::atan2(p.x_m, kRadius_m - p.y_m) - std::numbers::pi,
                                2.0 * std::numbers::pi) *
                     kRadius_m +
                 std::numbers::pi * kRadius_m};
}

// Standard normal (Box-Muller).
inline double draw_normal(std::mt19937_64& random) {
  const double u = 1.0 - pitwall::testing::draw_uniform(random);
  return std::sqrt(-2.0 * std::log(u)) *
         std::cos(2.0 * std::numbers::pi * pitwall::testing::draw_uniform(random));
}

// Without noise: the detection of a car by each sensor.
inline world::Detection seen(world::DetectionSource source, const TruePose& own,
                             const TruePose& car) {
  const double dx_m = car.x_m - own.x_m, dy_m = car.y_m - own.y_m;
  const double c = std::cos(own.yaw_rad), s = std::sin(own.yaw_rad);
  world::Detection d{.confidence = 0.9};
  const double x_m = c * dx_m + s * dy_m, y_m = c * dy_m - s * dx_m;
  if (source == world::DetectionSource::kLidar) {
    d.x_m = x_m, d.y_m = y_m, d.yaw_rad = wrap_pi(car.yaw_rad - own.yaw_rad);
    d.length_m = 4.9, d.width_m = 1.9;
    return d;
  }
  const double range_m = std::hypot(x_m, y_m);
  d.bearing_rad = std::atan2(y_m, x_m);
  if (source == world::DetectionSource::kCamera) {
    d.inverse_depth_per_m = 1.0 / range_m;
    return d;
  }
  const double wx_mps = car.speed_mps * std::cos(car.yaw_rad) - own.speed_mps * c;
  const double wy_mps = car.speed_mps * std::sin(car.yaw_rad) - own.speed_mps * s;
  d.range_m = range_m;
  d.range_rate_mps = (dx_m * wx_mps + dy_m * wy_mps) / range_m;
  return d;
}

inline Measurement measured(world::DetectionSource source, const world::Detection& d) {
  switch (source) {
    case world::DetectionSource::kCamera:
      return {{d.bearing_rad, d.inverse_depth_per_m, kUnset, kUnset, kUnset}, d.confidence};
    case world::DetectionSource::kRadar:
      return {{d.range_m, d.bearing_rad, d.range_rate_mps, kUnset, kUnset}, d.confidence};
    case world::DetectionSource::kLidar:
      break;
  }
  return {{d.x_m, d.y_m, d.yaw_rad, d.length_m, d.width_m}, d.confidence};
}

}  // namespace pitwall::tracking::testing
