// That they reach a car is tested in tests/system/dds.
// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/live/publishers/detection_publisher.hpp"

#include <gtest/gtest.h>

namespace pitwall::bench {
namespace {

io::SensorFile lidar_of_unit(std::uint8_t unit) {
  io::SensorFile file{
      .domain = {.domain = 69},
      .sensors = {{"image", "/image", io::SensorType::kImage, 20.0, {}},
                  {"lidar", "/lidar", io::SensorType::kDetection3DArray, 20.0, {}}}};
  file.sensors[1].detections.unit = unit;
  return file;
}

TEST(DetectionPublisher, ARowWithoutASimulatedSensorIsRefused) {
  const auto opened =
      DetectionPublisher::open(lidar_of_unit(7), sensors::av21_detection_sensors(), {}, 1);
  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error().place, "lidar");
}

TEST(DetectionPublisher, WhereNobodyListensNothingIsSentAndNothingIsLost) {
  auto publisher =
      DetectionPublisher::open(lidar_of_unit(0), sensors::av21_detection_sensors(), {}, 1);
  ASSERT_TRUE(publisher) << to_string(publisher.error());
  const plant::CarPose ours{.x_m = 0.0,
                            .y_m = 0.0,
                            .yaw_rad = 0.0,
                            .vx_mps = 0.0,
                            .vy_mps = 0.0,
                            .length_m = 4.92,
                            .width_m = 1.89};
  plant::CarPose other = ours;
  other.x_m = 30.0;
  for (Instant at{}; at < Instant{} + seconds(1); at += milliseconds(5))
    publisher->step({ours, std::span{&other, 1}}, at, Instant{});
  EXPECT_EQ(publisher->sent(), 0U);
  EXPECT_EQ(publisher->lost(), 0U);
}

}  // namespace
}  // namespace pitwall::bench
