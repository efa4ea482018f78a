// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/ingress/sensor_file.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace pitwall::io {
namespace {

Result<SensorFile, Problem> read(const std::string& text) {
  const auto path = std::filesystem::temp_directory_path() /
                    ("pitwall-sensors-" + std::to_string(getpid()) + ".yaml");
  std::ofstream{path} << text;
  auto file = read_sensor_file(path.string());
  std::filesystem::remove(path);
  return file;
}

std::string why(const std::string& text) {
  const auto file = read(text);
  return file ? "taken" : file.error().what;
}

TEST(SensorFile, IsReadAsItStands) {
  const auto file = read(R"(
domain: 7
interface: 192.168.10.5
peers: [192.168.10.7]
sensors:
  - {name: lidar, topic: /luminar_front/points, type: PointCloud2, rate_hz: 20}
  - {name: camera, topic: /camera/image, type: Image, rate_hz: 37.5}
)");
  ASSERT_TRUE(file) << to_string(file.error());
  EXPECT_EQ(file->domain.domain, 7);
  EXPECT_EQ(file->domain.interface, "192.168.10.5");
  EXPECT_EQ(file->domain.peers, std::vector<std::string>{"192.168.10.7"});
  ASSERT_EQ(file->sensors.size(), 2U);
  EXPECT_EQ(file->sensors[0].topic, "/luminar_front/points");
  EXPECT_EQ(file->sensors[1].type, SensorType::kImage);
  EXPECT_EQ(file->sensors[1].rate_hz, 37.5);
}

TEST(SensorFile, IsOnLoopbackWhereItDoesNotSayOtherwise) {
  const auto file = read("sensors: [{name: imu, topic: /imu, type: Imu, rate_hz: 100}]");
  ASSERT_TRUE(file) << to_string(file.error());
  EXPECT_EQ(file->domain.domain, 0);
  EXPECT_EQ(file->domain.interface, "127.0.0.1");
}

TEST(SensorFile, AMistakeIsNamed) {
  const auto row = [](const std::string& name, const std::string& topic, const std::string& type,
                      const std::string& rate) {
    return "  - {name: " + name + ", topic: " + topic + ", type: " + type + ", rate_hz: " + rate +
           "}\n";
  };
  const std::string good = row("lidar", "/points", "PointCloud2", "20");
  EXPECT_NE(why("sensors:\n" + row("Lidar", "/points", "PointCloud2", "20")), "taken");
  EXPECT_NE(why("sensors:\n" + row("lidar", "points", "PointCloud2", "20")), "taken");
  EXPECT_NE(why("sensors:\n" + row("lidar", "/points", "LaserScan", "20")), "taken");
  EXPECT_NE(why("sensors:\n" + row("lidar", "/points", "PointCloud2", "0")), "taken");
  EXPECT_NE(why("sensors:\n" + good + row("lidar", "/other", "Imu", "20")), "taken");
  EXPECT_NE(why("sensors:\n" + good + row("other", "/points", "Imu", "20")), "taken");
  EXPECT_NE(why("domain: 102\nsensors:\n" + good), "taken");
  EXPECT_NE(why("sensors: []\n"), "taken");
  EXPECT_NE(why("sensor:\n" + good), "taken");
  EXPECT_EQ(why("sensors:\n" + good), "taken");
}

}  // namespace
}  // namespace pitwall::io
