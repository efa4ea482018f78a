// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/ingress/detection_inbox.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "protocol/ros/cdr.hpp"
#include "protocol/ros/messages/vision.hpp"

namespace pitwall::io {
namespace {

constexpr UtcTime kUtc{1'800'000'000 * kNanosecondsPerSecond + 250'000'000};
constexpr Instant kNow{seconds(100).ns};

// A message that was measured so long before kUtc.
std::vector<std::uint8_t> measured(Duration ago, std::size_t cars = 1,
                                   const std::string& frame_id = "base_link") {
  ros::Detection3DArray message;
  message.header.frame_id = frame_id;
  const std::int64_t ns = kUtc.ns - ago.ns;
  message.header.stamp = {.sec = static_cast<std::int32_t>(ns / kNanosecondsPerSecond),
                          .nanosec = static_cast<std::uint32_t>(ns % kNanosecondsPerSecond)};
  ros::Detection3D car;
  car.results = {{.hypothesis = {.class_id = "car", .score = 0.9}, .pose = {}}};
  message.detections.assign(cars, car);
  std::vector<std::uint8_t> bytes;
  ros::encode(message, bytes);
  return bytes;
}

DetectionInbox inbox_of_lidar() { return {SensorType::kDetection3DArray, {}}; }

TEST(DetectionInbox, AFrameIsDatedByItsStampOnTheClockOfTheCar) {
  DetectionInbox inbox = inbox_of_lidar();
  EXPECT_EQ(inbox.front(), nullptr);
  EXPECT_EQ(inbox.receive(measured(milliseconds(90)), kUtc, kNow), milliseconds(90));
  ASSERT_NE(inbox.front(), nullptr);
  EXPECT_EQ(inbox.front()->at, kNow - milliseconds(90));
  EXPECT_EQ(inbox.front()->received, kNow);
  EXPECT_EQ(inbox.front()->detections.size(), 1U);
  inbox.pop();
  EXPECT_EQ(inbox.front(), nullptr);
  EXPECT_EQ(inbox.counts(), (DetectionCounts{.taken = 1}));
}

// Bounds by one nanosecond each.
TEST(DetectionInbox, WhatIsFromTheFutureOrOfLongAgoIsRefused) {
  DetectionInbox inbox = inbox_of_lidar();
  EXPECT_TRUE(inbox.receive(measured(-DetectionInbox::kAheadMost), kUtc, kNow));
  EXPECT_FALSE(inbox.receive(measured(-DetectionInbox::kAheadMost - Duration{1}), kUtc, kNow));
  EXPECT_TRUE(inbox.receive(measured(DetectionInbox::kOldest), kUtc, kNow));
  EXPECT_FALSE(inbox.receive(measured(DetectionInbox::kOldest + Duration{1}), kUtc, kNow));
  EXPECT_FALSE(inbox.receive(measured(Duration{kUtc.ns}), kUtc, kNow)) << "no stamp at all";
  EXPECT_EQ(inbox.counts(), (DetectionCounts{.taken = 2, .in_future = 1, .too_old = 2}));
}

TEST(DetectionInbox, EveryMessageThatIsNotTakenHasItsCount) {
  DetectionInbox inbox = inbox_of_lidar();
  std::vector<std::uint8_t> cut = measured({});
  cut.pop_back(), cut.pop_back(), cut.pop_back(), cut.pop_back();
  EXPECT_FALSE(inbox.receive(cut, kUtc, kNow));
  EXPECT_FALSE(inbox.receive({}, kUtc, kNow));
  EXPECT_FALSE(inbox.receive(measured({}, 1, "lidar"), kUtc, kNow));
  EXPECT_FALSE(inbox.receive(measured({}, 1'000), kUtc, kNow));
  EXPECT_EQ(inbox.counts(), (DetectionCounts{.refused = 2, .foreign_frames = 1, .too_many = 1}));
  EXPECT_EQ(inbox.front(), nullptr);
}

TEST(DetectionInbox, ALoopThatDoesNotTakeKeepsTheFirstAndTheOthersAreCounted) {
  DetectionInbox inbox = inbox_of_lidar();
  for (std::size_t i = 0; i < FrameQueue::kRoom + 3; ++i)
    inbox.receive(measured({}), kUtc, kNow + Duration{static_cast<std::int64_t>(i)});
  EXPECT_EQ(inbox.counts(), (DetectionCounts{.taken = FrameQueue::kRoom, .no_room = 3}));
  for (std::size_t i = 0; i < FrameQueue::kRoom; ++i) {
    ASSERT_NE(inbox.front(), nullptr);
    EXPECT_EQ(inbox.front()->received, kNow + Duration{static_cast<std::int64_t>(i)});
    inbox.pop();
  }
  EXPECT_EQ(inbox.front(), nullptr);
  EXPECT_TRUE(inbox.receive(measured({}), kUtc, kNow)) << "there is room again";
}

}  // namespace
}  // namespace pitwall::io
