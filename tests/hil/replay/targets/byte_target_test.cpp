// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/targets/byte_target.hpp"

#include <gtest/gtest.h>

#include "vehicle/io/arguments/receiver_link.hpp"

namespace pitwall::replay {
namespace {

TEST(ByteTarget, IsReadInEveryForm) {
  const std::vector<std::pair<std::string, std::string>> forms{
      {"3001", "127.0.0.1:3001"},
      {"10.0.0.7:3001", "10.0.0.7:3001"},
      {"udp:10.0.0.7:3001", "10.0.0.7:3001"},
      {"tcp:3001", "tcp:127.0.0.1:3001"},
      {"tcp:0.0.0.0:3001", "tcp:0.0.0.0:3001"},
      {"serial:/dev/ttyUSB0", "serial:/dev/ttyUSB0:460800"},
      {"serial:/dev/ttyUSB0:115200", "serial:/dev/ttyUSB0:115200"}};
  for (const auto& [text, canonical] : forms) {
    const auto target = parse_receiver_target(text);
    ASSERT_TRUE(target) << to_string(target.error());
    EXPECT_EQ(to_string(*target), canonical);
    EXPECT_EQ(parse_receiver_target(canonical).value_or(TcpPort{}), *target);
  }
}

TEST(ByteTarget, TheCarReadsTheSameString) {
  for (const char* text : {"udp:127.0.0.1:3001", "tcp:127.0.0.1:3001", "serial:/dev/ttyS0",
                           "serial:/dev/ttyS0:9600"}) {
    EXPECT_TRUE(parse_receiver_target(text)) << text;
    EXPECT_TRUE(io::parse_receiver_link(text)) << text;
  }
}

TEST(ByteTarget, WhatIsNoneIsNamed) {
  for (const char* text : {"", "here:3001", "127.0.0.1:0", "127.0.0.1:65536", "tcp:", "tcp:x:1",
                           "serial:", "serial:ttyUSB0", "serial:/dev/ttyUSB0:fast",
                           "serial:/dev/ttyUSB0:12345", "sctp:127.0.0.1:3001"}) {
    const auto target = parse_receiver_target(text);
    ASSERT_FALSE(target) << text;
    EXPECT_EQ(target.error().place, text);
  }
}

TEST(ByteTarget, ATopicOfRosHasItsNamesInDds) {
  const auto imu = ros_topic("/vehicle/imu", "sensor_msgs/msg/Imu");
  ASSERT_TRUE(imu) << to_string(imu.error());
  EXPECT_EQ(*imu, (RosTopic{"rt/vehicle/imu", "sensor_msgs::msg::dds_::Imu_"}));
  EXPECT_EQ(to_string(ByteTarget{*imu}), "rt/vehicle/imu");
  for (const char* type : {"", "Imu", "sensor_msgs/Imu", "a/b/c/d", "/msg/Imu", "a//Imu", "a/msg/"})
    EXPECT_FALSE(ros_topic("/imu", type)) << type;
  EXPECT_FALSE(ros_topic("imu", "sensor_msgs/msg/Imu"));
}

TEST(ByteTarget, TwoReceiversMixOnlyInTheSamePlace) {
  const auto same = [](const char* a, const char* b) {
    return is_same_place(*parse_receiver_target(a), *parse_receiver_target(b));
  };
  EXPECT_TRUE(same("3001", "udp:127.0.0.1:3001"));
  EXPECT_TRUE(same("serial:/dev/ttyS0:9600", "serial:/dev/ttyS0:115200"));
  EXPECT_FALSE(same("3001", "tcp:3001"));
  EXPECT_FALSE(same("3001", "3002"));
  EXPECT_FALSE(same("serial:/dev/ttyS0", "serial:/dev/ttyS1"));
}

}  // namespace
}  // namespace pitwall::replay
