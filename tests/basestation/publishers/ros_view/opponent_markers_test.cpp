// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/ros_view/opponent_markers.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>
#include <utility>

#include "tests/basestation/publishers/ros_view/sample_state.hpp"

namespace pitwall::publishers::ros_view {
namespace {

using telemetry::field;
using telemetry::Group;
using telemetry::Snapshot;
using testing::kNow;
using testing::sample_state;

constexpr std::int32_t kAdd = 0, kDelete = 2;
constexpr double kPi = 3.14159265358979;

std::vector<ros::Marker> markers_of(const Snapshot& state) {
  return opponent_markers(CarMessages{Frames{}, testing::kUtc}, state, testing::circle(), kNow)
      .markers;
}

TEST(OpponentMarkers, AKnownOpponentHasABoxAnArrowADiskAndAText) {
  Snapshot state = sample_state();
  state.values[field("opponent_1.position_sigma")] = 0.5;
  state.values[field("opponent_1.age")] = 0.1;
  const auto markers = markers_of(state);
  ASSERT_EQ(markers.size(), kMarkersEach * kOpponents);
  for (std::size_t i = 0; i < kMarkersEach; ++i) {
    EXPECT_EQ(markers[i].action, kAdd) << i;
    EXPECT_NEAR(std::hypot(markers[i].pose.position.x, markers[i].pose.position.y), 298.0, 0.05);
    EXPECT_EQ(markers[i].header.frame_id, "map");
  }
  // Types of visualization_msgs/Marker.
  EXPECT_EQ(markers[0].type, 1);
  EXPECT_EQ(markers[1].type, 0);
  EXPECT_EQ(markers[2].type, 3);
  EXPECT_EQ(markers[3].type, 9);
  EXPECT_DOUBLE_EQ(markers[1].scale.x, 60.0) << "the way in a second";
  // Tangent to the circle, counter-clockwise.
  const ros::Pose& pose = markers[1].pose;
  const double yaw_rad = 2.0 * std::atan2(pose.orientation.z, pose.orientation.w);
  EXPECT_NEAR(
      std::remainder(yaw_rad - std::atan2(pose.position.y, pose.position.x) - 0.5 * kPi, 2.0 * kPi),
      0.0, 0.02);
  EXPECT_DOUBLE_EQ(markers[2].scale.x, 2.0) << "two sigmas to each side";
  EXPECT_DOUBLE_EQ(markers[2].scale.y, 2.0);
  EXPECT_EQ(markers[3].text, "9: 60.0 m/s");
}

TEST(OpponentMarkers, OneThatIsOnlyCarriedOnIsTranslucentAndSaysSinceWhen) {
  Snapshot state = sample_state();
  state.values[field("opponent_1.age")] = kCoastsAfter_s;
  const float seen = markers_of(state)[0].color.a;
  state.values[field("opponent_1.age")] = 1.46;
  const auto markers = markers_of(state);
  EXPECT_LT(markers[0].color.a, 0.5F * seen);
  EXPECT_EQ(markers[3].text, "9: 60.0 m/s, seen 1.5 s ago");
}

TEST(OpponentMarkers, WhatIsNotKnownIsDeleted) {
  const auto markers = markers_of(sample_state());
  for (std::size_t i = kMarkersEach; i < markers.size(); ++i)
    EXPECT_EQ(markers[i].action, kDelete) << i;
  Snapshot late = sample_state();
  late.at(Group::kOpponent1) = kNow - seconds(3);
  for (const ros::Marker& marker : markers_of(late)) EXPECT_EQ(marker.action, kDelete);
  Snapshot standing = sample_state();
  standing.values[field("opponent_1.speed")] = 0.0;
  standing.values[field("opponent_1.position_sigma")] = kUnset;
  const auto some = markers_of(standing);
  EXPECT_EQ(some[0].action, kAdd);
  EXPECT_EQ(some[1].action, kDelete) << "no arrow without a length";
  EXPECT_EQ(some[2].action, kDelete);
  EXPECT_EQ(some[3].action, kAdd);
}

TEST(OpponentMarkers, EachIsTheSameOneInEveryMessage) {
  std::set<std::pair<std::string, std::int32_t>> names;
  for (const ros::Marker& marker : markers_of(sample_state())) names.insert({marker.ns, marker.id});
  EXPECT_EQ(names.size(), kMarkersEach * kOpponents);
}

}  // namespace
}  // namespace pitwall::publishers::ros_view
