// What others publish is tested in tests/system/dds, by others.
// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/ingress/sensor_ingress.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace pitwall::io {
namespace {

ros::PointCloud2 cloud() {
  ros::PointCloud2 made;
  made.height = 2;
  made.width = 3;
  made.point_step = 16;
  made.row_step = 48;
  made.fields = {{"x", 0, 7, 1}, {"intensity", 12, 7, 1}};
  made.data.resize(96);
  return made;
}

TEST(SensorIngress, ACloudWhoseSizesDisagreeIsRefused) {
  EXPECT_EQ(contradiction_of(cloud()), nullptr);
  EXPECT_EQ(contradiction_of(ros::PointCloud2{}), nullptr) << "an empty one is a cloud";
  ros::PointCloud2 bad = cloud();
  bad.data.pop_back();
  EXPECT_NE(contradiction_of(bad), nullptr);
  bad = cloud(), bad.width = 4;
  EXPECT_NE(contradiction_of(bad), nullptr);
  bad = cloud(), bad.fields[1].offset = 13;
  EXPECT_NE(contradiction_of(bad), nullptr);
  bad = cloud(), bad.fields[0].datatype = 9;
  EXPECT_NE(contradiction_of(bad), nullptr);
  bad = cloud(), bad.fields[0].count = 0xFFFF'FFFF;
  EXPECT_NE(contradiction_of(bad), nullptr);
  bad = cloud(), bad.point_step = 0x8000'0001, bad.width = 2, bad.row_step = 2;  // 2^32 + 2
  EXPECT_NE(contradiction_of(bad), nullptr);
}

TEST(SensorIngress, AnImageWhoseSizesDisagreeIsRefused) {
  ros::Image image;
  image.height = 4, image.width = 6, image.encoding = "mono8", image.step = 8;
  image.data.resize(32);
  EXPECT_EQ(contradiction_of(image), nullptr);
  image.data.resize(31);
  EXPECT_NE(contradiction_of(image), nullptr);
  image.data.resize(20), image.step = 5;
  EXPECT_NE(contradiction_of(image), nullptr);
}

TEST(SensorIngress, AFixOrARateThatCannotBeIsRefused) {
  ros::NavSatFix fix;
  fix.latitude = 36.0, fix.longitude = -115.0;
  EXPECT_EQ(contradiction_of(fix), nullptr);
  fix.latitude = 91.0;
  EXPECT_NE(contradiction_of(fix), nullptr);
  fix.latitude = std::nan("");
  EXPECT_NE(contradiction_of(fix), nullptr);
  fix.status.status = -1;
  EXPECT_EQ(contradiction_of(fix), nullptr) << "it says itself that it has none";
  ros::Imu imu;
  EXPECT_EQ(contradiction_of(imu), nullptr);
  imu.angular_velocity.y = std::nan("");
  EXPECT_NE(contradiction_of(imu), nullptr);
  imu.angular_velocity_covariance[0] = -1.0;
  EXPECT_EQ(contradiction_of(imu), nullptr);
}

TEST(SensorIngress, ADomainThatCannotBeIsRefused) {
  EXPECT_FALSE(SensorIngress::start(
      {.domain = {.domain = 500}, .sensors = {{"imu", "/imu", SensorType::kImu, 100.0}}}));
}

}  // namespace
}  // namespace pitwall::io
