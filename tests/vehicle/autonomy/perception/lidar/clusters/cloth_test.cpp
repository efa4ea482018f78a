// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/perception/lidar/clusters/cloth.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/vehicle/autonomy/perception/lidar/lidar_scene.hpp"

namespace pitwall::perception {
namespace {

const SceneBox kCar{.x_m = 25.0, .y_m = 3.0, .yaw_rad = 0.1};

TEST(Cloth, LiesOnARoadThatLeans) {
  for (const double lean : {0.0, 0.05, -0.1}) {
    const LidarScene scene{.lean = lean, .boxes = {kCar}};
    PointCloud points = sweep_of(scene, 3);
    std::erase_if(points, [](const auto& p) { return p.x_m > 100.0F || std::abs(p.y_m) > 20.0F; });
    const Cloth cloth{points, {}};
    for (const LidarPoint& p : points) {
      const double road_m = lean * p.y_m - scene.sensor_m;
      if (std::abs(p.x_m - kCar.x_m) < 4.0 && std::abs(p.y_m - kCar.y_m) < 3.0) continue;
      // The lowest point of a cell, and half a cell of slope.
      EXPECT_NEAR(cloth.height_m(p.x_m, p.y_m), road_m, 0.1 + 0.5 * std::abs(lean))
          << lean << " at " << p.x_m << ", " << p.y_m;
    }
  }
}

TEST(Cloth, DoesNotRiseOntoACar) {
  const PointCloud points = sweep_of({.boxes = {kCar}}, 4);
  const Cloth cloth{points, {}};
  EXPECT_NEAR(cloth.height_m(kCar.x_m, kCar.y_m), -1.0, 0.2);
}

TEST(Cloth, RoundsTheEdgeOfAStepWithinACell) {
  PointCloud points;
  for (float x_m = 0.0F; x_m <= 20.0F; x_m += 0.5F)
    for (float y_m = -5.0F; y_m <= 5.0F; y_m += 0.5F)
      points.push_back({x_m, y_m, x_m < 10.0F ? 0.0F : -1.0F, 0.0F});
  const Cloth cloth{points, {}};
  EXPECT_NEAR(cloth.height_m(8.0, 0.0), 0.0, 0.01);
  EXPECT_GT(cloth.height_m(9.0, 0.0), -0.5);
  EXPECT_NEAR(cloth.height_m(10.0, 0.0), -1.0, 0.01);
}

TEST(Cloth, IsTheGroundBesideTheAreaToo) {
  const Cloth cloth{PointCloud{{0, 0, 2, 0}, {5, 0, 2, 0}, {0, 5, 2, 0}, {5, 5, 2, 0}}, {}};
  EXPECT_NEAR(cloth.height_m(2.5, 2.5), 2.0, 0.01);
  EXPECT_NEAR(cloth.height_m(-100.0, 40.0), 2.0, 0.01);
}

TEST(Cloth, WithoutPointsIsAtZero) { EXPECT_EQ(Cloth({}, {}).height_m(3.0, 4.0), 0.0); }

}  // namespace
}  // namespace pitwall::perception
