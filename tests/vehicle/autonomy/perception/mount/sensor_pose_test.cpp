// Against Eigen's rotations about axes.
// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/perception/mount/sensor_pose.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

#include "tests/support/draw.hpp"

namespace pitwall::perception {
namespace {

TEST(SensorPose, PlacesInBodyByYawPitchAndRoll) {
  using Eigen::AngleAxisd, Eigen::Vector3d;
  std::mt19937_64 random{11};
  const auto drawn = [&](double most) { return testing::draw_uniform(random, -most, most); };
  for (int i = 0; i < 100; ++i) {
    const SensorPose pose{drawn(2), drawn(1), drawn(1), drawn(3), drawn(1.5), drawn(3)};
    const std::array<double, 3> at{drawn(50), drawn(50), drawn(50)};
    const Vector3d expected =
        AngleAxisd(pose.yaw_rad, Vector3d::UnitZ()) *
            (AngleAxisd(pose.pitch_rad, Vector3d::UnitY()) *
             (AngleAxisd(pose.roll_rad, Vector3d::UnitX()) * Vector3d{at[0], at[1], at[2]})) +
        Vector3d{pose.x_m, pose.y_m, pose.z_m};
    const auto body = in_body(pose, axes_of(pose), at);
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_NEAR(body[k], expected[static_cast<Eigen::Index>(k)], 1e-12) << i;
  }
}

TEST(SensorPose, PositivePitchIsNoseDownAndPositiveYawIsLeft) {
  const auto ahead = [](const SensorPose& pose) {
    return in_body(pose, axes_of(pose), {1.0, 0.0, 0.0});
  };
  EXPECT_LT(ahead({.pitch_rad = 0.1})[2], 0.0);
  EXPECT_GT(ahead({.yaw_rad = 0.1})[1], 0.0);
}

}  // namespace
}  // namespace pitwall::perception
