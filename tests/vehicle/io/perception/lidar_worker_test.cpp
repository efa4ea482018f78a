// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/perception/lidar_worker.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <mutex>
#include <optional>

#include "protocol/transport/clock.hpp"
#include "protocol/yaml/strict_map.hpp"
#include "tests/vehicle/io/perception/car_cloud.hpp"
#include "tests/vehicle/io/perception/cloud_message.hpp"

namespace pitwall::io {
namespace {

// A LiDAR without a network between it and the worker.
class Lidar {
 public:
  LidarSource source() {
    return {{.mount = {.z_m = kSensor_m}, .horizon = milliseconds(10)}, [this] { return take(); }};
  }
  void send(ros::PointCloud2 message) {
    const std::lock_guard lock{mutex_};
    next_ = std::move(message);
  }
  void send(const perception::PointCloud& points, Duration ago = milliseconds(60)) {
    send(cloud_message(points, UtcTime{transport::utc_now().ns - ago.ns}));
  }
  bool is_taken() {
    const std::lock_guard lock{mutex_};
    return !next_;
  }

 private:
  const ros::PointCloud2* take() {
    const std::lock_guard lock{mutex_};
    if (!next_) return nullptr;
    taken_ = *std::move(next_);
    next_.reset();
    return &taken_;
  }

  std::mutex mutex_;
  std::optional<ros::PointCloud2> next_;
  ros::PointCloud2 taken_;  // of the worker's thread
};

template <class Condition>
bool comes(const Condition& condition) {
  for (const Instant end = transport::monotonic_now() + seconds(20);
       transport::monotonic_now() < end;) {
    if (condition()) return true;
    transport::sleep_until(transport::monotonic_now() + milliseconds(1));
  }
  return condition();
}

TEST(LidarWorker, MakesAFrameOfTheSweepsOfItsSensors) {
  std::array<Lidar, 2> lidars;
  const auto worker =
      LidarWorker::start({lidars[0].source(), lidars[1].source()}, traffic::oval(), std::nullopt);
  ASSERT_NE(worker, nullptr);
  worker->report(ego_at_rest());
  const perception::PointCloud far = car_cloud(30.0, 2.0), near = car_cloud(15.0, -3.0);
  const Instant before = transport::monotonic_now();
  lidars[0].send(far), lidars[1].send(near);
  const Instant after = transport::monotonic_now();
  std::vector<world::Detection> found;
  ASSERT_TRUE(comes([&] {
    for (; worker->front() != nullptr; worker->pop(transport::monotonic_now())) {
      const world::DetectionFrame& frame = *worker->front();
      EXPECT_EQ(frame.source, world::DetectionSource::kLidar);
      EXPECT_GE(frame.received, before);
      EXPECT_GT(frame.at, before - milliseconds(95)) << "60 ms ago, and the horizon's 10";
      EXPECT_LT(frame.at, after - milliseconds(5));
      for (const world::Detection& d : frame.detections) found.push_back(d);
    }
    return found.size() >= 2;
  }));
  ASSERT_EQ(found.size(), 2U);
  double x_m = 0.0, y_m = 0.0;
  for (const world::Detection& d : found) x_m += d.x_m, y_m += d.y_m;
  EXPECT_NEAR(x_m, 45.0, 0.5);
  EXPECT_NEAR(y_m, -1.0, 0.4);
  EXPECT_EQ(worker->counts().sweeps, 2U);
}

// Taken 300 ms after its stamp, whenever it was made.
TEST(LidarWorker, SaysHowOldTheOldestPointIsWhenTheLoopTakesAFrame) {
  Lidar lidar;
  const auto worker = LidarWorker::start({lidar.source()}, traffic::oval(), std::nullopt);
  worker->report(ego_at_rest());
  const perception::PointCloud points = car_cloud(30.0, 2.0);
  const Instant stamp = transport::monotonic_now() - milliseconds(60);
  lidar.send(points);
  const double late_ms = (transport::monotonic_now() - stamp).milliseconds() - 60.0;
  ASSERT_TRUE(comes([&] { return worker->front() != nullptr; }));
  worker->pop(stamp + milliseconds(300));
  const auto row = yaml::load_text(worker->json(transport::monotonic_now()), "row.json");
  ASSERT_TRUE(row);
  const auto age_ms = yaml::read(*row, [](yaml::StrictMap& map) {
    const double p50_ms = map.number("to_loop_p50_ms", 0.0, 1e6);
    for (const std::string& name : map.keys())
      if (name != "name" && name != "to_loop_p50_ms") map.number(name, 0.0, 1e12);
    map.text("name");
    return p50_ms;
  });
  ASSERT_TRUE(age_ms) << to_string(age_ms.error());
  EXPECT_GE(*age_ms, 299.0 - late_ms);
  EXPECT_LE(*age_ms, 301.0);
}

TEST(LidarWorker, InThePublishedWayADeadSensorStopsAll) {
  std::array<Lidar, 2> lidars;
  const auto worker = LidarWorker::start({lidars[0].source(), lidars[1].source()}, traffic::oval(),
                                         std::nullopt, Gathering::kAll);
  worker->report(ego_at_rest());
  const perception::PointCloud points = car_cloud(30.0, 2.0);
  for (std::uint64_t sweep = 1; sweep <= 3; ++sweep) {
    lidars[1].send(points);
    ASSERT_TRUE(comes([&] { return worker->counts().sweeps == sweep; }));
  }
  EXPECT_EQ(worker->counts().frames, 0U);
  lidars[0].send(points), lidars[1].send(points);
  EXPECT_TRUE(comes([&] { return worker->counts().frames == 1; }));
}

TEST(LidarWorker, ADeadSensorDelaysNoOther) {
  std::array<Lidar, 3> lidars;
  const auto worker = LidarWorker::start(
      {lidars[0].source(), lidars[1].source(), lidars[2].source()}, traffic::oval(), std::nullopt);
  worker->report(ego_at_rest());
  const perception::PointCloud points = car_cloud(30.0, 2.0);
  for (std::uint64_t sweep = 1; sweep <= 5; ++sweep) {
    lidars[1].send(points);
    ASSERT_TRUE(comes([&] { return worker->counts().frames == sweep; })) << sweep;
  }
  EXPECT_EQ(worker->counts().sweeps, 5U);
}

TEST(LidarWorker, WhatCannotBeUsedIsCounted) {
  Lidar lidar;
  const auto worker = LidarWorker::start({lidar.source()}, traffic::oval(), std::nullopt);
  worker->report(ego_at_rest());
  const perception::PointCloud points = car_cloud(30.0, 2.0);
  lidar.send(points, milliseconds(700));
  ASSERT_TRUE(comes([&] { return worker->counts().bad_stamps == 1; }));
  lidar.send(points, milliseconds(-200));
  ASSERT_TRUE(comes([&] { return worker->counts().bad_stamps == 2; }));
  ros::PointCloud2 flat = cloud_message(points, transport::utc_now());
  flat.fields.resize(2);
  lidar.send(flat);
  ASSERT_TRUE(comes([&] { return worker->counts().unreadable == 1; }));
  EXPECT_EQ(worker->counts().frames, 0U);
  const Instant now = transport::monotonic_now();
  EXPECT_EQ(worker->frame_figures(now).drops, 3U);
  EXPECT_TRUE(std::isnan(worker->frame_figures(now).arrivals.rate_hz));
  EXPECT_EQ(worker->frame_figures(now + SensorFigures::kAwaited).arrivals.rate_hz, 0.0)
      << "no frame yet, but there is to be one";
  lidar.send(points);
  ASSERT_TRUE(comes([&] { return worker->counts().frames == 1; })) << "it goes on";
}

TEST(LidarWorker, FramesThatNobodyTakesAreCounted) {
  Lidar lidar;
  const auto worker = LidarWorker::start({lidar.source()}, traffic::oval(), std::nullopt);
  for (std::uint64_t sweep = 1; sweep <= FrameQueue::kRoom + 3; ++sweep) {
    lidar.send(perception::PointCloud{});
    ASSERT_TRUE(comes([&] { return worker->counts().frames == sweep; }));
  }
  EXPECT_EQ(worker->counts().no_room, 3U);
  EXPECT_EQ(worker->frame_figures(transport::monotonic_now()).drops, 3U);
  const auto row = yaml::load_text(worker->json(transport::monotonic_now()), "row.json");
  ASSERT_TRUE(row) << "JSON is YAML";
}

TEST(LidarWorker, WithoutASourceThereIsNone) {
  EXPECT_EQ(LidarWorker::start({}, traffic::oval(), std::nullopt), nullptr);
}

}  // namespace
}  // namespace pitwall::io
