// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/perception/lidar/motion.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

namespace pitwall::perception {
namespace {

using Eigen::AngleAxisd, Eigen::Vector3d;

Eigen::Isometry3d pose_of(const SensorPose& mount) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translate(Vector3d{mount.x_m, mount.y_m, mount.z_m});
  pose.rotate(AngleAxisd(mount.yaw_rad, Vector3d::UnitZ()) *
              AngleAxisd(mount.pitch_rad, Vector3d::UnitY()) *
              AngleAxisd(mount.roll_rad, Vector3d::UnitX()));
  return pose;
}

// Body at a time, in Body at time 0: on a circle, exactly.
Eigen::Isometry3d moved(const BodyMotion& motion, double time_s) {
  const double yaw_rad = motion.yaw_rate_rad_per_s * time_s;
  const double ahead = std::abs(yaw_rad) < 1e-9 ? 1.0 : std::sin(yaw_rad) / yaw_rad;
  const double left = std::abs(yaw_rad) < 1e-9 ? 0.0 : (1.0 - std::cos(yaw_rad)) / yaw_rad;
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translate(time_s * Vector3d{ahead * motion.vx_mps - left * motion.vy_mps,
                                   left * motion.vx_mps + ahead * motion.vy_mps, 0.0});
  pose.rotate(AngleAxisd(yaw_rad, Vector3d::UnitZ()));
  return pose;
}

TEST(SweepMotion, WhatStandsStillIsInOnePlace) {
  const std::vector<SensorPose> mounts{
      {1.2, 0.0, 0.5, 0.0, 0.05, 0.0}, {-0.4, 0.4, 0.6, 0.02, 0.0, 2.1}, {.yaw_rad = -2.1}};
  const std::vector<BodyMotion> motions{{}, {70.0, -1.0, 0.35}, {30.0, 0.5, -0.8}, {5.0, 0.0, 0.0}};
  const Vector3d place{43.0, -12.0, 0.7};
  for (const SensorPose& mount : mounts) {
    for (const BodyMotion& motion : motions) {
      for (const double time_s : {-0.05, -0.012, 0.0, 0.02, 0.04}) {
        const Vector3d seen = (moved(motion, time_s) * pose_of(mount)).inverse() * place;
        const LidarPoint ray{static_cast<float>(seen.x()), static_cast<float>(seen.y()),
                             static_cast<float>(seen.z()), 0.3F, 0.05F};
        PointCloud cloud;
        append_in_body({mount, {&ray, 1}, time_s - 0.05}, motion, cloud);
        ASSERT_EQ(cloud.size(), 1U);
        EXPECT_NEAR(cloud[0].x_m, place.x(), 0.002) << time_s;
        EXPECT_NEAR(cloud[0].y_m, place.y(), 0.002) << time_s;
        EXPECT_NEAR(cloud[0].z_m, place.z(), 1e-4) << time_s;
        EXPECT_NEAR(cloud[0].after_s, time_s, 1e-6);
        EXPECT_EQ(cloud[0].intensity, 0.3F);
      }
    }
  }
}

TEST(SweepMotion, SweepsAreAppendedAndBadPointsStayBad) {
  const std::vector<LidarPoint> rays{{1.0F, 0.0F, 0.0F},
                                     {std::numeric_limits<float>::quiet_NaN(), 0.0F, 0.0F}};
  PointCloud cloud;
  append_in_body({{}, rays, 0.0}, {}, cloud);
  append_in_body({{.x_m = 2.0}, rays, 0.0}, {}, cloud);
  ASSERT_EQ(cloud.size(), 4U);
  EXPECT_EQ(cloud[0].x_m, 1.0F);
  EXPECT_FALSE(is_finite(cloud[1]));
  EXPECT_EQ(cloud[2].x_m, 3.0F);
}

}  // namespace
}  // namespace pitwall::perception
