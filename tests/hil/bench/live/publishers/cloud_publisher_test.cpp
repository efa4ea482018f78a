// That clouds reach a car is tested in tests/system/dds.
// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/live/publishers/cloud_publisher.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "tests/hil/traffic/oval.hpp"
#include "vehicle/io/ingress/sensor_ingress.hpp"
#include "vehicle/io/perception/cloud_codec.hpp"

namespace pitwall::bench {
namespace {

TEST(CloudPublisher, ACloudIsReadAsItsReturns) {
  const std::vector<sensors::LidarReturn> returns{{1.0F, -2.0F, 3.0F, 0.25F, 0.0F, -1},
                                                  {40.0F, 5.0F, -0.5F, 0.5F, 0.0126F, 2}};
  const ros::PointCloud2 cloud = cloud_of(returns);
  EXPECT_EQ(io::contradiction_of(cloud), nullptr);
  perception::PointCloud points;
  ASSERT_EQ(io::read_points(cloud, points), nullptr);
  ASSERT_EQ(points.size(), returns.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_EQ(points[i].x_m, returns[i].x_m);
    EXPECT_EQ(points[i].y_m, returns[i].y_m);
    EXPECT_EQ(points[i].z_m, returns[i].z_m);
    EXPECT_EQ(points[i].intensity, returns[i].intensity);
    EXPECT_EQ(points[i].after_s, returns[i].after_s);
  }
}

TEST(CloudPublisher, WithoutAMountThereIsNone) {
  const io::SensorFile file{
      .domain = {.domain = 69},
      .sensors = {{"points", "/points", io::SensorType::kPointCloud2, 20.0, {}}}};
  const auto opened =
      CloudPublisher::open(file, traffic::oval(), [](double) { return 0.0; }, 1, {});
  ASSERT_TRUE(opened) << to_string(opened.error());
  EXPECT_EQ(*opened, nullptr);
}

}  // namespace
}  // namespace pitwall::bench
