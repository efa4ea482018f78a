// SPDX-License-Identifier: Apache-2.0
#include "protocol/ros/names.hpp"

#include <gtest/gtest.h>

namespace pitwall::ros {
namespace {

std::string why(std::string_view topic) {
  const auto got = dds_topic(topic);
  return got ? "taken as " + *got : got.error().what;
}

TEST(RosNames, TopicsAndTypesAreCalledAsRmwCallsThem) {
  EXPECT_EQ(*dds_topic("/vehicle/odom"), "rt/vehicle/odom");
  EXPECT_EQ(*dds_topic("/tf_static"), "rt/tf_static");
  EXPECT_EQ(dds_type("std_msgs/msg/String"), "std_msgs::msg::dds_::String_");
  EXPECT_EQ(dds_type("nav_msgs/msg/Odometry"), "nav_msgs::msg::dds_::Odometry_");
}

TEST(RosNames, WhatRosWouldRefuseIsRefusedWithTheReason) {
  EXPECT_EQ(why(""), "does not begin with '/'");
  EXPECT_EQ(why("odom"), "does not begin with '/'");
  EXPECT_EQ(why("/odom/"), "ends with '/'");
  EXPECT_EQ(why("/"), "ends with '/'");
  EXPECT_EQ(why("/a//b"), "holds '//'");
  EXPECT_EQ(why("/a b"), "holds ' '");
  EXPECT_EQ(why("/car/2nd"), "a part begins with a digit");
  EXPECT_EQ(why("/" + std::string(kTopicMax, 'a')), "longer than 247 characters");
  EXPECT_EQ(why("/" + std::string(kTopicMax - 1, 'a')).substr(0, 8), "taken as");
  EXPECT_EQ(dds_topic("odom").error().place, "topic 'odom'");
}

}  // namespace
}  // namespace pitwall::ros
