// That messages reach a reader is tested in tests/system/dds.
// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/live/publishers/scene_sender.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>

#include "protocol/ros/describe.hpp"
#include "protocol/ros/messages/sensor.hpp"
#include "protocol/transport/clock.hpp"
#include "tests/hil/traffic/oval_cars.hpp"
#include "tests/support/comes_true.hpp"

namespace pitwall::bench {
namespace {

SceneWriters writers(int domain) {
  const io::SensorRow row{"points", "/points", io::SensorType::kPointCloud2, 20.0, {}};
  auto opened =
      open_writers({.domain = {.domain = domain}, .sensors = {row}}, {row}, ros::PointCloud2::kType,
                   ros::type_hash(ros::describe<ros::PointCloud2>()));
  EXPECT_TRUE(opened) << to_string(opened.error());
  return *std::move(opened);
}

TEST(SceneSender, SendsWhatIsMadeWhenItIsDue) {
  SceneSender sender{writers(67), [](const SceneMoment& moment) {
                       return std::vector<SceneMessage>{
                           {.due = moment.begun + milliseconds(60), .bytes = {0, 1, 0, 0}}};
                     }};
  const Instant begun = transport::monotonic_now();
  sender.show({.begun = begun});
  ASSERT_TRUE(testing::comes_true([&] {
    const SensorFeed feed = sender.counts();
    return feed.sent + feed.refused == 1;
  }));
  EXPECT_GE(transport::monotonic_now(), begun + milliseconds(60));
  EXPECT_GE(sender.counts().late_max_ms, 0.0);
}

TEST(SceneSender, WhatComesWhileItIsBusyIsSkippedAndCounted) {
  std::atomic<bool> goes_on{false};
  std::atomic<int> made{0};
  SceneSender sender{writers(67), [&](const SceneMoment&) {
                       ++made;
                       testing::comes_true([&] { return goes_on.load(); });
                       return std::vector<SceneMessage>{};
                     }};
  sender.show({});
  ASSERT_TRUE(testing::comes_true([&] { return made == 1; }));
  sender.show({}), sender.show({});
  EXPECT_EQ(sender.counts().skipped, 2U);
  goes_on = true;
  ASSERT_TRUE(testing::comes_true([&] {
    sender.show({});
    return made >= 2;
  }));
}

TEST(SceneSender, AMomentHasTheCarsWhereTheyAreAndTheFaultsOfItsTime) {
  const std::vector<plant::CarPose> others{traffic::pose_on_oval(130.0, 2.0, 50.0)};
  const std::vector<faults::BenchFault> faults{
      {.kind = faults::BenchFaultKind::kCameraOutage, .start = Instant{} + seconds(1), .unit = 1}};
  const plant::Truth ours = traffic::truth_on_oval(100.0, 60.0);
  const auto at = [&](Instant time) {
    return moment_of(traffic::oval(), ours, 100.0, others, time, time, faults);
  };
  const SceneMoment before = at(Instant{});
  EXPECT_EQ(before.ours.at_m[0], ours.x_m);
  ASSERT_EQ(before.others.size(), 1U);
  EXPECT_EQ(before.others[0].at_m[0], others[0].x_m);
  EXPECT_FALSE(before.cameras.outage[1]);
  EXPECT_TRUE(at(Instant{} + seconds(1)).cameras.outage[1]);
}

}  // namespace
}  // namespace pitwall::bench
