// Sensors that another DDS publishes, and what the car makes of them.
// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/ingress/sensor_ingress.hpp"

#include <gtest/gtest.h>
#include <peer.h>

#include <cmath>
#include <numeric>

#include "tests/system/dds/cyclone_peer.hpp"

namespace pitwall::io {
namespace {

using pitwall::testing::comes;
using pitwall::testing::CyclonePeer;

constexpr pitwall::testing::Ask kSensorData{.reliable = false, .depth = 5};

peer_Header header_now() {
  const UtcTime now = transport::utc_now();
  static char frame[] = "lidar";
  return {{static_cast<std::int32_t>(now.ns / kNanosecondsPerSecond),
           static_cast<std::uint32_t>(now.ns % kNanosecondsPerSecond)},
          frame};
}

// A cloud that needs many datagrams.
struct Cloud {
  static constexpr std::uint32_t kPoints = 20'000, kPointBytes = 16;

  Cloud() : bytes(std::size_t{kPoints} * kPointBytes) {
    std::iota(bytes.begin(), bytes.end(), std::uint8_t{0});
    message.header = header_now();
    message.height = 1;
    message.width = kPoints;
    message.fields = {1, 1, &field, false};
    message.point_step = kPointBytes;
    message.row_step = kPoints * kPointBytes;
    message.data = {static_cast<std::uint32_t>(bytes.size()),
                    static_cast<std::uint32_t>(bytes.size()), bytes.data(), false};
    message.is_dense = true;
  }
  char name[2] = "x";
  peer_PointField field{name, 0, 7, 1};
  std::vector<std::uint8_t> bytes;
  peer_PointCloud2 message{};
};

SensorFile file_of(int domain) {
  return {.domain = {.domain = domain},
          .sensors = {{"lidar", "/lidar/points", SensorType::kPointCloud2, 20.0},
                      {"camera", "/camera/image", SensorType::kImage, 20.0},
                      {"imu", "/imu", SensorType::kImu, 100.0},
                      {"gnss", "/fix", SensorType::kNavSatFix, 10.0}}};
}
constexpr std::size_t kLidar = 0, kCamera = 1, kImu = 2, kGnss = 3;

TEST(SensorPeers, TakesTheNewestOfEachAndMeasuresHowItComes) {
  auto ingress = SensorIngress::start(file_of(61));
  ASSERT_TRUE(ingress) << to_string(ingress.error());
  CyclonePeer peer{61};
  const auto lidar = peer.writer(peer_PointCloud2_desc, "sensor_msgs::msg::dds_::PointCloud2_",
                                 "rt/lidar/points", kSensorData);
  const auto imu =
      peer.writer(peer_Imu_desc, "sensor_msgs::msg::dds_::Imu_", "rt/imu", kSensorData);
  const auto fix =
      peer.writer(peer_NavSatFix_desc, "sensor_msgs::msg::dds_::NavSatFix_", "rt/fix", kSensorData);
  ASSERT_TRUE(comes([&] {
    Cloud cloud;
    peer_Imu sample{};
    sample.header = header_now();
    sample.angular_velocity.z = 0.25;
    peer_NavSatFix place{};
    place.header = header_now();
    place.latitude = 36.0;
    dds_write(lidar, &cloud.message), dds_write(imu, &sample), dds_write(fix, &place);
    return (*ingress)->counts(kLidar).samples >= 5 && (*ingress)->counts(kImu).samples >= 5 &&
           (*ingress)->counts(kGnss).samples >= 5;
  })) << (*ingress)->json(transport::monotonic_now());
  const auto* const cloud = (*ingress)->take<ros::PointCloud2>(kLidar);
  ASSERT_NE(cloud, nullptr);
  EXPECT_EQ(cloud->data, Cloud{}.bytes);
  EXPECT_EQ(cloud->header.frame_id, "lidar");
  const auto* const rates = (*ingress)->take<ros::Imu>(kImu);
  ASSERT_NE(rates, nullptr);
  EXPECT_EQ(rates->angular_velocity.z, 0.25);
  // The last one written may still be on its way.
  EXPECT_TRUE(comes([&] { return (*ingress)->take<ros::PointCloud2>(kLidar) == nullptr; }))
      << "taken already";
  EXPECT_EQ((*ingress)->take<ros::Image>(kLidar), nullptr) << "another type";
  EXPECT_GE((*ingress)->counts(kLidar).overwritten, 4U);
  const auto figures_of = [&](SensorType type, std::size_t unit) {
    return (*ingress)->figures(type, unit, transport::monotonic_now());
  };
  const auto figures = figures_of(SensorType::kPointCloud2, 0);
  ASSERT_TRUE(figures);
  EXPECT_GT(figures->arrivals.rate_hz, 0.0);
  EXPECT_GE(figures->arrivals.latency_ms, 0.0);
  EXPECT_EQ(figures->drops, 0U) << "nobody looks in its points";
  EXPECT_FALSE(figures_of(SensorType::kPointCloud2, 1));
  EXPECT_FALSE(figures_of(SensorType::kRadarScan, 0));
  // The camera is silent, and that is nobody else's matter.
  EXPECT_TRUE(std::isnan((*ingress)->figures(kCamera, transport::monotonic_now()).rate_hz));
  EXPECT_TRUE(std::isnan(figures_of(SensorType::kImage, 0)->arrivals.rate_hz));
  const Instant later = transport::monotonic_now() + SensorFigures::kAwaited;
  EXPECT_EQ((*ingress)->figures(SensorType::kImage, 0, later)->arrivals.rate_hz, 0.0)
      << "but the car has it";
  EXPECT_TRUE(
      comes([&] { return figures_of(SensorType::kPointCloud2, 0)->arrivals.rate_hz == 0.0; }));
}

TEST(SensorPeers, WhatIsNoMessageOfItsTypeIsRefusedAndCounted) {
  auto ingress = SensorIngress::start(file_of(62));
  ASSERT_TRUE(ingress) << to_string(ingress.error());
  CyclonePeer peer{62};
  // The right name, and other bytes: a cloud that is an Other, so it is cut short.
  const auto cut = peer.writer(peer_Other_desc, "sensor_msgs::msg::dds_::PointCloud2_",
                               "rt/lidar/points", kSensorData);
  // Another type on the topic of the camera.
  const auto foreign =
      peer.writer(peer_Imu_desc, "sensor_msgs::msg::dds_::Imu_", "rt/camera/image", kSensorData);
  // Rows that are longer than the data.
  const auto imu =
      peer.writer(peer_Imu_desc, "sensor_msgs::msg::dds_::Imu_", "rt/imu", kSensorData);
  ASSERT_TRUE(comes([&] {
    const peer_Other other{.number = 1};
    peer_Imu sample{};
    sample.header = header_now();
    sample.angular_velocity.x = std::nan("");
    dds_write(cut, &other), dds_write(foreign, &sample), dds_write(imu, &sample);
    return (*ingress)->counts(kLidar).refused >= 3 &&
           (*ingress)->counts(kCamera).foreign_types >= 1 && (*ingress)->counts(kImu).refused >= 3;
  })) << (*ingress)->json(transport::monotonic_now());
  for (const std::size_t i : {kLidar, kCamera, kImu}) {
    EXPECT_EQ((*ingress)->counts(i).samples, 0U);
    EXPECT_TRUE(std::isnan((*ingress)->figures(i, transport::monotonic_now()).rate_hz));
  }
  EXPECT_EQ((*ingress)->take<ros::PointCloud2>(kLidar), nullptr);
}

}  // namespace
}  // namespace pitwall::io
