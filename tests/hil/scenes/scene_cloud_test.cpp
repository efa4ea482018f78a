// SPDX-License-Identifier: Apache-2.0
#include "hil/scenes/scene_cloud.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "hil/sensors/lidar/car_mesh.hpp"
#include "tests/hil/traffic/oval.hpp"

namespace pitwall::scenes {
namespace {

TEST(SceneCloud, HoldsEveryReturnAndLiesOnTheRoad) {
  sensors::SceneMaker maker{traffic::oval(), {sensors::av21_shape()}, {.dust = 0.0}};
  const sensors::LidarScene scene = maker.make(3);
  const perception::PointCloud cloud = merged(scene);
  std::size_t returns = 0;
  for (const sensors::UnitSweep& sweep : scene.sweeps) returns += sweep.returns.size();
  ASSERT_EQ(cloud.size(), returns);
  const perception::TrackGrid grid{traffic::oval()};
  const auto ground = perception::TrackGround::fit(grid, pose_of(scene), cloud);
  ASSERT_TRUE(ground);
  std::size_t on_road = 0, near = 0;
  for (const perception::LidarPoint& p : cloud) {
    const auto at = std::hypot(p.x_m, p.y_m) < 30.0F ? ground->at(p) : std::nullopt;
    if (!at) continue;
    ++near;
    on_road += std::abs(at->over_m) < 0.1;
  }
  EXPECT_GT(near, 1'000U);
  EXPECT_GT(static_cast<double>(on_road), 0.7 * static_cast<double>(near)) << "the rest is cars";
}

}  // namespace
}  // namespace pitwall::scenes
