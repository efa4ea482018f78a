// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/recordings/ros_message.hpp"

#include <gtest/gtest.h>

#include "protocol/ros/cdr.hpp"
#include "protocol/ros/messages/nav.hpp"
#include "protocol/ros/messages/sensor.hpp"
#include "tests/hil/replay/recordings/recording_samples.hpp"

namespace pitwall::traffic {
namespace {

constexpr std::string_view kClassic = "can_msgs/msg/Frame";
constexpr std::string_view kFd = "ros2_socketcan_msgs/msg/FdFrame";

struct ClassicFields {
  std::uint32_t id = 0x123;
  bool is_rtr = false, is_extended = false, is_error = false;
  std::uint8_t dlc = 3;
};

std::vector<std::uint8_t> classic(const ClassicFields& fields) {
  std::vector<std::uint8_t> bytes;
  ros::CdrWriter writer{bytes};
  writer.put(ros::Header{});
  writer.put(fields.id);
  for (const bool flag : {fields.is_rtr, fields.is_extended, fields.is_error}) writer.put(flag);
  writer.put(fields.dlc);
  writer.put(std::array<std::uint8_t, 8>{1, 2, 3, 4, 5, 6, 7, 8});
  return bytes;
}

std::vector<std::uint8_t> with_flexible_rate(std::uint8_t length, std::size_t there) {
  std::vector<std::uint8_t> bytes;
  ros::CdrWriter writer{bytes};
  writer.put(ros::Header{});
  writer.put(std::uint32_t{0x7FF});
  writer.put(false);
  writer.put(false);
  writer.put(length);
  writer.put(std::vector<std::uint8_t>(there, 9));
  return bytes;
}

TEST(RosMessage, ReadsClassicFrames) {
  EXPECT_TRUE(is_ros_can(kClassic) && is_ros_can(kFd));
  EXPECT_FALSE(is_ros_can("sensor_msgs/msg/Imu"));
  const auto plain = read_ros_can(kClassic, classic({}));
  ASSERT_TRUE(plain);
  EXPECT_FALSE(plain->is_error);
  can::Frame expected{.id = 0x123, .length = 3};
  expected.data = {1, 2, 3};
  EXPECT_EQ(plain->frame, expected);
  const auto remote = read_ros_can(kClassic, classic({.is_rtr = true}));
  EXPECT_EQ(remote->frame, (can::Frame{.id = 0x123, .remote = true, .length = 3}));
  EXPECT_TRUE(read_ros_can(kClassic, classic({.is_error = true}))->is_error);
}

TEST(RosMessage, ReadsFramesWithFlexibleDataRate) {
  const auto message = read_ros_can(kFd, with_flexible_rate(12, 64));
  ASSERT_TRUE(message);
  EXPECT_TRUE(message->frame.fd);
  EXPECT_EQ(message->frame.length, 12);
  EXPECT_EQ(message->frame.data[11], 9);
  EXPECT_EQ(message->frame.data[12], 0);
}

TEST(RosMessage, RefusesWhatNoBusCarries) {
  const auto reason = [](std::string_view type, Bytes cdr) {
    const auto message = read_ros_can(type, cdr);
    return message ? std::string{} : message.error();
  };
  EXPECT_EQ(reason(kClassic, classic({.dlc = 9})), "can_msgs/msg/Frame: more than 8 bytes");
  EXPECT_EQ(reason(kClassic, classic({.id = 0x800})),
            "can_msgs/msg/Frame: identifier out of range");
  EXPECT_EQ(reason(kClassic, classic({.id = 0x800, .is_extended = true})), "");
  EXPECT_EQ(reason(kClassic, classic({.id = 0x2000'0000, .is_extended = true})),
            "can_msgs/msg/Frame: identifier out of range");
  EXPECT_EQ(reason(kFd, with_flexible_rate(9, 9)),
            "ros2_socketcan_msgs/msg/FdFrame: length that CAN FD has not");
  EXPECT_EQ(reason(kFd, with_flexible_rate(8, 7)),
            "ros2_socketcan_msgs/msg/FdFrame: length that CAN FD has not");
  const auto bytes = classic({});
  for (std::size_t n = 0; n < bytes.size(); ++n)
    EXPECT_EQ(reason(kClassic, Bytes{bytes}.first(n)),
              "can_msgs/msg/Frame: message that cannot be read")
        << n;
}

template <class M>
void expect_every_cut_to_be_a_fault() {
  std::vector<std::uint8_t> bytes;
  ros::encode(M{}, bytes);
  EXPECT_EQ(fault_of(M::kType, bytes), std::nullopt);
  for (std::size_t n = 0; n < bytes.size(); ++n)
    EXPECT_NE(fault_of(M::kType, Bytes{bytes}.first(n)), std::nullopt) << M::kType << " " << n;
  bytes.resize(bytes.size() + 8);
  EXPECT_NE(fault_of(M::kType, bytes), std::nullopt);
}

TEST(RosMessage, SensorMessagesAreReadAsAWhole) {
  expect_every_cut_to_be_a_fault<ros::NavSatFix>();
  expect_every_cut_to_be_a_fault<ros::Imu>();
  expect_every_cut_to_be_a_fault<ros::Odometry>();
  expect_every_cut_to_be_a_fault<ros::PointCloud2>();
}

TEST(RosMessage, OfOtherTypesOnlyTheEncapsulationIsKnown) {
  const std::array<std::uint8_t, 6> good{0, 1, 0, 0, 7, 7}, bad{7, 1, 0, 0, 7, 7};
  EXPECT_EQ(fault_of("team_msgs/msg/Any", good), std::nullopt);
  EXPECT_EQ(fault_of("team_msgs/msg/Any", bad), "ROS 2 message that is not CDR");
  EXPECT_EQ(fault_of("team_msgs/msg/Any", Bytes{good}.first(3)), "ROS 2 message that is not CDR");
}

}  // namespace
}  // namespace pitwall::traffic
