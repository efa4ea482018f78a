// That they reach a reader is tested in tests/system/dds.
// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/perception/debug_topics.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace pitwall::io {
namespace {

world::DetectionFrame one(world::DetectionSource source, const world::Detection& detection) {
  world::DetectionFrame frame{.source = source, .unit = 1};
  EXPECT_TRUE(frame.detections.push(detection));
  return frame;
}

TEST(DebugTopics, ABoxOfALidarIsACubeWhereItStands) {
  world::Detection box;
  box.x_m = 20.0, box.y_m = -3.0, box.yaw_rad = 0.4, box.length_m = 4.9, box.width_m = 1.9;
  box.confidence = 1.0;
  const ros::MarkerArray all = markers_of(one(world::DetectionSource::kLidar, box), {7, 8});
  ASSERT_EQ(all.markers.size(), 2U);
  EXPECT_EQ(all.markers[0].action, 3) << "those of the frame before go";
  const ros::Marker& cube = all.markers[1];
  EXPECT_EQ(cube.type, 1);
  EXPECT_EQ(cube.action, 0);
  EXPECT_EQ(cube.header.frame_id, "base_link");
  EXPECT_EQ(cube.header.stamp.sec, 7);
  EXPECT_EQ(cube.pose.position.x, 20.0);
  EXPECT_EQ(cube.pose.position.y, -3.0);
  EXPECT_NEAR(2.0 * std::atan2(cube.pose.orientation.z, cube.pose.orientation.w), 0.4, 1e-12);
  EXPECT_EQ(cube.scale.x, 4.9);
  EXPECT_EQ(cube.scale.y, 1.9);
}

TEST(DebugTopics, ACarOfACameraIsASphereAlongItsBearing) {
  world::Detection seen;
  seen.bearing_rad = 0.1, seen.inverse_depth_per_m = 0.02, seen.confidence = 0.5;
  const ros::Marker sphere =
      markers_of(one(world::DetectionSource::kCamera, seen), {}).markers.at(1);
  EXPECT_EQ(sphere.type, 2);
  EXPECT_NEAR(sphere.pose.position.x, 50.0 * std::cos(0.1), 1e-12);
  EXPECT_NEAR(sphere.pose.position.y, 50.0 * std::sin(0.1), 1e-12);
  EXPECT_NE(markers_of(one(world::DetectionSource::kCamera, seen), {}).markers[1].ns, "sensor_0");
}

}  // namespace
}  // namespace pitwall::io
