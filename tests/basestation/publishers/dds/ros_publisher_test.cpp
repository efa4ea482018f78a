// What it says to others is tested in tests/system/dds, by others.
// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/dds/ros_publisher.hpp"

#include <gtest/gtest.h>

namespace pitwall::publishers::dds {
namespace {

TEST(RosPublisher, KnowsTheDistributionsByName) {
  EXPECT_EQ(*distribution_named("humble"), Distribution::kHumble);
  EXPECT_EQ(*distribution_named("iron"), Distribution::kJazzy);
  EXPECT_EQ(*distribution_named("jazzy"), Distribution::kJazzy);
  EXPECT_EQ(to_string(distribution_named("noetic").error()),
            "ROS 2 noetic: error: expected one of: humble, iron, jazzy");
}

TEST(RosPublisher, WhatCannotBeIsRefusedBeforeAnythingIsOpened) {
  RosConfig config;
  config.domain.domain = 200;
  EXPECT_FALSE(start(config));
  config.domain = {.domain = 1, .interface = "nowhere"};
  EXPECT_FALSE(start(config));
  config.domain = {.domain = 1, .peers = {"10.0.0"}};
  EXPECT_FALSE(start(config));
}

}  // namespace
}  // namespace pitwall::publishers::dds
