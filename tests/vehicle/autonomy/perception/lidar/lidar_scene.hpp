// A LiDAR's sweep over a road that leans to a side, with boxes on it: rays in the pattern of a
// Luminar (rings 0.54 degrees apart, a ray each 0.14 degrees), with noise along the ray.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <random>
#include <vector>

#include "tests/support/draw.hpp"
#include "vehicle/autonomy/perception/lidar/point_cloud.hpp"

namespace pitwall::perception {

struct SceneBox {
  double x_m, y_m, yaw_rad;
  double length_m = 4.92, width_m = 1.89, height_m = 1.2;
};

struct LidarScene {
  double lean = 0.0;      // rise of the road per metre to the left
  double sensor_m = 1.0;  // over the road
  double noise_m = 0.02;
  double from_rad = -1.05, to_rad = 1.05;  // of the rays, about the x axis
  std::vector<SceneBox> boxes;
};

namespace scene_rays {

using Vector = std::array<double, 3>;

// Where a ray from the origin meets a box that stands on the road, as a share of its length.
inline std::optional<double> hit(const LidarScene& scene, const SceneBox& box, const Vector& ray) {
  const double c = std::cos(box.yaw_rad), s = std::sin(box.yaw_rad);
  const double foot_m = scene.lean * box.y_m - scene.sensor_m;
  const Vector origin{-(box.x_m * c + box.y_m * s), box.x_m * s - box.y_m * c, -foot_m};
  const Vector way{ray[0] * c + ray[1] * s, ray[1] * c - ray[0] * s, ray[2]};
  const Vector least{-0.5 * box.length_m, -0.5 * box.width_m, 0.0};
  const Vector most{0.5 * box.length_m, 0.5 * box.width_m, box.height_m};
  double enters = 0.0, leaves = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    const double a = (least[k] - origin[k]) / way[k], b = (most[k] - origin[k]) / way[k];
    enters = std::max(enters, std::min(a, b));
    leaves = std::min(leaves, std::max(a, b));
  }
  if (enters >= leaves || enters <= 0.0) return std::nullopt;
  return enters;
}

}  // namespace scene_rays

inline PointCloud sweep_of(const LidarScene& scene, std::uint32_t seed) {
  constexpr double kDegree = 0.017453292519943295, kReach_m = 240.0;
  std::mt19937_64 random{seed};
  PointCloud points;
  for (int ring = 0; ring < 60; ++ring) {
    const double up_rad = (7.9 - 0.54 * ring) * kDegree;
    for (double at = scene.from_rad; at < scene.to_rad; at += 0.14 * kDegree) {
      const scene_rays::Vector ray{std::cos(up_rad) * std::cos(at), std::cos(up_rad) * std::sin(at),
                                   std::sin(up_rad)};
      const double sinks = ray[2] - scene.lean * ray[1];
      double nearest_m = sinks < 0.0 ? -scene.sensor_m / sinks : kReach_m;
      for (const SceneBox& box : scene.boxes)
        if (const auto at_m = scene_rays::hit(scene, box, ray))
          nearest_m = std::min(nearest_m, *at_m);
      if (nearest_m >= kReach_m) continue;
      nearest_m += testing::draw_normal(random, scene.noise_m);
      points.push_back({static_cast<float>(ray[0] * nearest_m),
                        static_cast<float>(ray[1] * nearest_m),
                        static_cast<float>(ray[2] * nearest_m), 0.1F});
    }
  }
  return points;
}

}  // namespace pitwall::perception
