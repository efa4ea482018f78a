// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/ros_view/car_messages.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/basestation/publishers/ros_view/sample_state.hpp"

namespace pitwall::publishers::ros_view {
namespace {

using telemetry::field;
using telemetry::Group;
using telemetry::Snapshot;
using testing::kNow;
using testing::sample_state;

const CarMessages kMessages{Frames{}, testing::kUtc};

TEST(CarMessages, TheStampIsTheSamplesTimeInUtc) {
  const auto odometry = kMessages.odometry(sample_state());
  ASSERT_TRUE(odometry);
  EXPECT_EQ(odometry->header.stamp.sec, 1'700'000'099);
  EXPECT_EQ(odometry->header.stamp.nanosec, 960'000'000U);
  EXPECT_EQ(odometry->header.frame_id, "map");
  EXPECT_EQ(odometry->child_frame_id, "base_link");
}

TEST(CarMessages, OdometryHasPoseSpeedAndTheirVariances) {
  const auto odometry = kMessages.odometry(sample_state());
  ASSERT_TRUE(odometry);
  EXPECT_EQ(odometry->pose.pose.position.x, 120.0);
  EXPECT_EQ(odometry->pose.pose.position.y, -45.0);
  EXPECT_EQ(odometry->pose.pose.position.z, 3.0);
  const ros::Quaternion wanted = quaternion_of(-0.1, 0.02, 0.5);
  EXPECT_EQ(odometry->pose.pose.orientation.w, wanted.w);
  EXPECT_EQ(odometry->twist.twist.linear.x, 66.0);
  EXPECT_EQ(odometry->twist.twist.angular.z, 0.125);
  EXPECT_DOUBLE_EQ(odometry->pose.covariance[0], 0.01);
  EXPECT_DOUBLE_EQ(odometry->pose.covariance[7], 0.04);
  EXPECT_DOUBLE_EQ(odometry->pose.covariance[14], 0.25);
  EXPECT_DOUBLE_EQ(odometry->pose.covariance[35], 1e-4);
}

TEST(CarMessages, WhereTheCarDoesNotKnowWhereItIsNothingIsSent) {
  for (const auto f : {field("ego.x"), field("ego.y"), field("ego.yaw"), field("ego.validity")}) {
    Snapshot state = sample_state();
    state.values[f] = kUnset;
    EXPECT_FALSE(kMessages.odometry(state) || kMessages.transform(state)) << f;
    EXPECT_FALSE(kMessages.fix(state, Ground{{36.0, -115.0, 0.0}}));
  }
  for (const double validity : {0.0, 3.0}) {  // never, lost
    Snapshot state = sample_state();
    state.values[field("ego.validity")] = validity;
    EXPECT_FALSE(kMessages.odometry(state));
  }
  EXPECT_FALSE(kMessages.odometry(Snapshot{}));
  EXPECT_FALSE(kMessages.imu(Snapshot{}));
}

// tf2 and RViz refuse a pose that holds NaN, so the plane stands in for it, and the variance tells.
TEST(CarMessages, AnUnknownHeightIsThatOfThePlaneWithAVarianceThatSaysSo) {
  Snapshot state = sample_state();
  for (const auto f : {field("localization.height"), field("localization.sigma_height"),
                       field("dynamics.roll"), field("dynamics.pitch")})
    state.values[f] = kUnset;
  const auto odometry = kMessages.odometry(state);
  ASSERT_TRUE(odometry);
  EXPECT_EQ(odometry->pose.pose.position.z, 0.0);
  for (const std::size_t i : {14U, 21U, 28U})
    EXPECT_EQ(odometry->pose.covariance[i], kUnknownVariance);
  const auto transform = kMessages.transform(state);
  ASSERT_TRUE(transform);
  EXPECT_EQ(transform->transforms[0].transform.rotation.w, quaternion_of(0, 0, 0.5).w);
  EXPECT_TRUE(std::isnan(kMessages.fix(state, Ground{{36.0, -115.0, 0.0}})->altitude));
}

TEST(CarMessages, AnUnknownSpeedIsNoNumber) {
  Snapshot state = sample_state();
  state.values[field("ego.vy")] = kUnset;
  const auto odometry = kMessages.odometry(state);
  ASSERT_TRUE(odometry);
  EXPECT_TRUE(std::isnan(odometry->twist.twist.linear.y));
  EXPECT_TRUE(std::isnan(odometry->twist.twist.linear.z));  // the car never tells it
  EXPECT_EQ(odometry->twist.covariance[14], kUnknownVariance);
}

// What lies seconds apart does not belong into one message.
TEST(CarMessages, AnOldValueOfAnotherGroupIsNotKnownAnyMore) {
  Snapshot state = sample_state();
  state.at(Group::kLocalization) = kNow - seconds(10);
  const auto odometry = kMessages.odometry(state);
  ASSERT_TRUE(odometry);
  EXPECT_EQ(odometry->pose.pose.position.z, 0.0);
  EXPECT_DOUBLE_EQ(odometry->pose.covariance[0], 0.0625);  // of the ego group itself
  EXPECT_EQ(odometry->pose.covariance[35], kUnknownVariance);
}

TEST(CarMessages, AnImuSaysWhichOfItsPartsItDoesNotMeasure) {
  const auto whole = kMessages.imu(sample_state());
  ASSERT_TRUE(whole);
  EXPECT_EQ(whole->linear_acceleration.y, 12.0);
  EXPECT_EQ(whole->orientation_covariance[0], 0.0);
  Snapshot state = sample_state();
  state.values[field("dynamics.roll_rate")] = kUnset;
  state.values[field("dynamics.roll")] = kUnset;
  const auto part = kMessages.imu(state);
  EXPECT_EQ(part->angular_velocity_covariance[0], -1.0);
  EXPECT_EQ(part->orientation_covariance[0], -1.0);
  EXPECT_EQ(part->linear_acceleration_covariance[0], 0.0);
  EXPECT_TRUE(std::isnan(part->angular_velocity.x));
}

TEST(CarMessages, AReceiverWithoutASolutionSaysNoFix) {
  const ros::NavSatFix top = kMessages.receiver_fix(sample_state(), 0);
  EXPECT_EQ(top.status.status, 2);  // corrections of the ground
  EXPECT_DOUBLE_EQ(top.position_covariance[0], 4e-4);
  EXPECT_EQ(top.position_covariance_type, 1);
  EXPECT_TRUE(std::isnan(top.latitude) && std::isnan(top.longitude) && std::isnan(top.altitude));
  const ros::NavSatFix bottom = kMessages.receiver_fix(sample_state(), 1);
  EXPECT_EQ(bottom.status.status, -1);
  EXPECT_EQ(bottom.position_covariance_type, 0);
  for (const auto& [type, status] : {std::pair{16, 0}, {18, 1}, {34, 2}, {56, 2}, {0, -1}}) {
    Snapshot state = sample_state();
    state.values[field("gnss0.type")] = type;
    EXPECT_EQ(kMessages.receiver_fix(state, 0).status.status, status) << type;
  }
}

TEST(CarMessages, TheFusedFixLiesWhereTheCarIs) {
  const Ground ground{{36.2722, -115.0103, 594.0}};
  const auto fix = kMessages.fix(sample_state(), ground);
  ASSERT_TRUE(fix);
  const Geodetic wanted = ground.at(120.0, -45.0, 3.0);
  EXPECT_EQ(fix->latitude, wanted.latitude_deg);
  EXPECT_EQ(fix->altitude, wanted.height_m);
  EXPECT_DOUBLE_EQ(fix->position_covariance[4], 0.0625);
}

TEST(CarMessages, TheRacelineIsClosed) {
  const ros::Path path = raceline(testing::circle(), kMessages.header(kNow, "map"));
  ASSERT_GT(path.poses.size(), 300U);
  EXPECT_EQ(path.poses.front().pose.position.x, path.poses.back().pose.position.x);
  for (const ros::PoseStamped& pose : path.poses)
    EXPECT_NEAR(std::hypot(pose.pose.position.x, pose.pose.position.y), 300.0, 0.05);
}

}  // namespace
}  // namespace pitwall::publishers::ros_view
