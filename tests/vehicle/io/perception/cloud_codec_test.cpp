// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/perception/cloud_codec.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "vehicle/io/ingress/sensor_ingress.hpp"

namespace pitwall::io {
namespace {

template <class Number>
void put(ros::PointCloud2& message, std::size_t at, Number value) {
  std::memcpy(message.data.data() + at, &value, sizeof value);
}

// Two rows of three points of 32 bytes, the rows 8 bytes apart.
ros::PointCloud2 cloud(const std::vector<ros::PointField>& more) {
  ros::PointCloud2 made;
  made.header.stamp = {1'000, 500'000'000};
  made.height = 2, made.width = 3, made.point_step = 32, made.row_step = 104;
  made.fields = {{"x", 0, 7, 1}, {"y", 4, 7, 1}, {"z", 8, 7, 1}};
  made.fields.insert(made.fields.end(), more.begin(), more.end());
  made.data.resize(208);
  for (std::size_t row = 0; row < 2; ++row)
    for (std::size_t column = 0; column < 3; ++column) {
      const std::size_t at = 104 * row + 32 * column;
      const auto number = static_cast<float>(3 * row + column);
      put(made, at, number), put(made, at + 4, -number), put(made, at + 8, 0.5F * number);
    }
  EXPECT_EQ(contradiction_of(made), nullptr);
  return made;
}

TEST(CloudCodec, ReadsThePointsOfAllRowsInTheirOrder) {
  perception::PointCloud points{{9.0F, 9.0F, 9.0F}};
  ASSERT_EQ(read_points(cloud({}), points), nullptr);
  ASSERT_EQ(points.size(), 6U) << "those from before are gone";
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(points[i].x_m, static_cast<float>(i));
    EXPECT_EQ(points[i].y_m, -static_cast<float>(i));
    EXPECT_EQ(points[i].z_m, 0.5F * static_cast<float>(i));
    EXPECT_EQ(points[i].intensity, 0.0F);
    EXPECT_EQ(points[i].after_s, 0.0F);
  }
}

TEST(CloudCodec, ReadsIntensityAndTimeAsTheDriversWriteThem) {
  const std::size_t last = 104 + 64;
  perception::PointCloud points;

  ros::PointCloud2 ouster = cloud({{"reflectivity", 12, 4, 1}, {"t", 16, 6, 1}});
  put(ouster, last + 12, std::uint16_t{300}), put(ouster, last + 16, std::uint32_t{25'000'000});
  ASSERT_EQ(read_points(ouster, points), nullptr);
  EXPECT_EQ(points[5].intensity, 300.0F);
  EXPECT_NEAR(points[5].after_s, 0.025F, 1e-7);

  ros::PointCloud2 livox = cloud({{"reflectivity", 12, 2, 1}, {"offset_time", 16, 6, 1}});
  put(livox, last + 12, std::uint8_t{77}), put(livox, last + 16, std::uint32_t{1'000'000});
  ASSERT_EQ(read_points(livox, points), nullptr);
  EXPECT_EQ(points[5].intensity, 77.0F);
  EXPECT_NEAR(points[5].after_s, 0.001F, 1e-8);

  ros::PointCloud2 velodyne = cloud({{"intensity", 12, 7, 1}, {"time", 16, 7, 1}});
  put(velodyne, last + 12, 0.25F), put(velodyne, last + 16, -0.03F);
  ASSERT_EQ(read_points(velodyne, points), nullptr);
  EXPECT_EQ(points[5].intensity, 0.25F);
  EXPECT_EQ(points[5].after_s, -0.03F);

  ros::PointCloud2 hesai = cloud({{"intensity", 12, 7, 1}, {"timestamp", 16, 8, 1}});
  for (std::size_t point = 0; point < 6; ++point)
    put(hesai, 104 * (point / 3) + 32 * (point % 3) + 16, 1'000.52);
  ASSERT_EQ(read_points(hesai, points), nullptr);
  EXPECT_NEAR(points[5].after_s, 0.02F, 1e-6);
}

TEST(CloudCodec, APointThatIsNoneStaysOne) {
  ros::PointCloud2 message = cloud({});
  put(message, 32, std::numeric_limits<float>::quiet_NaN());
  perception::PointCloud points;
  ASSERT_EQ(read_points(message, points), nullptr);
  ASSERT_EQ(points.size(), 6U);
  EXPECT_FALSE(is_finite(points[1]));
}

TEST(CloudCodec, WhatCannotBeReadSaysWhyAndHasNoPoints) {
  perception::PointCloud points{{1.0F, 1.0F, 1.0F}};
  ros::PointCloud2 bad = cloud({});
  bad.is_bigendian = true;
  EXPECT_STREQ(read_points(bad, points), "its numbers are big-endian");
  EXPECT_TRUE(points.empty());
  bad = cloud({}), bad.fields[2].name = "depth";
  EXPECT_STREQ(read_points(bad, points), "it has no x, y and z");
  bad = cloud({}), bad.fields[1].datatype = 1;  // signed bytes
  EXPECT_NE(read_points(bad, points), nullptr);
  bad = ros::PointCloud2{}, bad.fields = cloud({}).fields;
  bad.width = 500'000, bad.height = 1;
  EXPECT_STREQ(read_points(bad, points), "it has too many points");
}

TEST(CloudCodec, AnEmptyCloudIsOne) {
  perception::PointCloud points{{1.0F, 1.0F, 1.0F}};
  ros::PointCloud2 empty = cloud({});
  empty.height = 0, empty.data.clear();
  EXPECT_EQ(read_points(empty, points), nullptr);
  EXPECT_TRUE(points.empty());
}

}  // namespace
}  // namespace pitwall::io
