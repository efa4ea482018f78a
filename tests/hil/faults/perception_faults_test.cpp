// SPDX-License-Identifier: Apache-2.0
#include "hil/faults/perception_faults.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace pitwall::faults {
namespace {

using enum BenchFaultKind;
using world::DetectionFrame, world::DetectionSource;

constexpr int kSeconds = 20;

plant::CarPose car_at(double x_m, double y_m) {
  return {.x_m = x_m,
          .y_m = y_m,
          .yaw_rad = 0.0,
          .vx_mps = 0.0,
          .vy_mps = 0.0,
          .length_m = 4.92,
          .width_m = 1.89};
}

// One car ahead, one to the left rear; under these faults.
std::vector<DetectionFrame> frames_of(const std::vector<BenchFault>& faults) {
  const auto sensors = sensors::av21_detection_sensors();
  auto state = sensors::make_detections(sensors, 5, Instant{});
  const plant::CarPose ours = car_at(0.0, 0.0);
  const std::array others{car_at(30.0, 0.0), car_at(-20.0, 15.0)};
  std::vector<DetectionFrame> frames;
  for (Instant now{}; now < Instant{} + seconds(kSeconds); now += milliseconds(10)) {
    apply_perception_faults(faults, now, sensors, state);
    sensors::Arrivals out;
    sensors::step_detections(sensors, state, {ours, others}, now, out);
    frames.insert(frames.end(), out.begin(), out.end());
  }
  EXPECT_EQ(state.overflows, 0U);
  return frames;
}

std::size_t frames_from(const std::vector<DetectionFrame>& frames, DetectionSource source,
                        std::uint8_t unit) {
  return static_cast<std::size_t>(std::ranges::count_if(frames, [&](const DetectionFrame& frame) {
    return frame.source == source && frame.unit == unit;
  }));
}

std::size_t boxes(const std::vector<DetectionFrame>& frames, bool ahead) {
  std::size_t n = 0;
  for (const DetectionFrame& frame : frames)
    for (const world::Detection& seen : frame.detections)
      n += frame.source == DetectionSource::kLidar && seen.confidence >= 0.75 &&
           (seen.x_m > 0.0) == ahead;
  return n;
}

TEST(PerceptionFaults, ACameraOrRadarThatIsOutSendsNothingAndTheOthersGoOn) {
  const auto healthy = frames_of({});
  for (const auto& [kind, source] : {std::pair{kCameraOutage, DetectionSource::kCamera},
                                     std::pair{kRadarOutage, DetectionSource::kRadar}}) {
    const auto frames = frames_of({{.kind = kind, .unit = 1}});
    EXPECT_EQ(frames_from(frames, source, 1), 0U);
    EXPECT_EQ(frames.size() + frames_from(healthy, source, 1), healthy.size());
  }
}

TEST(PerceptionFaults, OneEndsWithItsTime) {
  const auto frames =
      frames_of({{.kind = kCameraOutage, .start = Instant{} + seconds(5), .duration = seconds(5)}});
  for (const DetectionFrame& frame : frames) {
    const bool is_meant = frame.source == DetectionSource::kCamera && frame.unit == 0;
    EXPECT_TRUE(!is_meant || frame.at < Instant{} + seconds(5) ||
                frame.at >= Instant{} + seconds(10));
  }
  EXPECT_GT(frames_from(frames, DetectionSource::kCamera, 0), 250U) << "of 300";
}

TEST(PerceptionFaults, ALidarThatIsOutHidesItsThirdAlone) {
  const auto healthy = frames_of({}), front = frames_of({{.kind = kLidarOutage, .unit = 0}}),
             left = frames_of({{.kind = kLidarOutage, .unit = 1}}),
             right = frames_of({{.kind = kLidarOutage, .unit = 2}});
  ASSERT_GT(boxes(healthy, true), 200U);
  ASSERT_GT(boxes(healthy, false), 200U);
  EXPECT_EQ(boxes(front, true), 0U);
  EXPECT_GT(boxes(front, false), 200U);
  EXPECT_GT(boxes(left, true), 200U);
  EXPECT_EQ(boxes(left, false), 0U);
  EXPECT_EQ(boxes(frames_of(std::vector<BenchFault>(20, {.kind = kLidarOutage, .unit = 1})), false),
            0U)
      << "twenty times is once";
  EXPECT_GT(boxes(right, true), 200U);
  EXPECT_GT(boxes(right, false), 200U);
}

TEST(PerceptionFaults, LateFramesKeepTheTimeOfTheirMeasurement) {
  const auto healthy = frames_of({}), late = frames_of({{.kind = kLidarLate, .value = 0.1},
                                                        {.kind = kLidarLate, .value = 0.05}});
  const auto ages = [](const std::vector<DetectionFrame>& frames) {
    std::vector<double> all;
    for (const DetectionFrame& frame : frames)
      if (frame.source == DetectionSource::kLidar)
        all.push_back((frame.received - frame.at).seconds());
    return all;
  };
  const auto before = ages(healthy), after = ages(late);
  ASSERT_GT(after.size(), 300U);
  for (std::size_t i = 0; i < after.size(); ++i) EXPECT_NEAR(after[i], before[i] + 0.15, 1e-9);
}

// A count of a Poisson distribution: 5 sigma.
TEST(PerceptionFaults, DustIsSeenAsThatManyCars) {
  constexpr double kEach_s = 40.0;
  const auto low = [](const std::vector<DetectionFrame>& frames) {
    std::size_t n = 0;
    for (const DetectionFrame& frame : frames)
      for (const world::Detection& seen : frame.detections)
        n += frame.source == DetectionSource::kLidar && seen.confidence < 0.6;
    return static_cast<double>(n);
  };
  // Six in ten of the false ones have less confidence than any car; the frames that never come
  // and what is nearer or farther than LiDARs see are a tenth.
  const double expected = kEach_s * kSeconds * 0.6;
  EXPECT_NEAR(low(frames_of({{.kind = kDust, .value = kEach_s}})) - low(frames_of({})),
              0.94 * expected, 0.06 * expected + 5.0 * std::sqrt(expected));
}

TEST(PerceptionFaults, WhatFollowsIsWhatWouldHaveComeWithoutThem) {
  const auto sum_after = [](const std::vector<DetectionFrame>& frames) {
    double sum = 0.0;
    for (const DetectionFrame& frame : frames)
      if (frame.at >= Instant{} + seconds(11))
        for (const world::Detection& seen : frame.detections)
          for (const double figure : {seen.x_m, seen.bearing_rad, seen.range_m, seen.confidence})
            sum += std::isfinite(figure) ? figure : 0.0;
    return sum;
  };
  const double healthy = sum_after(frames_of({}));
  for (const auto& [kind, value] :
       {std::pair{kLidarOutage, 0.0}, std::pair{kLidarLate, 0.2}, std::pair{kCameraOutage, 0.0},
        std::pair{kRadarOutage, 0.0}, std::pair{kDust, 30.0}}) {
    const auto frames = frames_of(
        {{.kind = kind, .start = Instant{} + seconds(5), .duration = seconds(5), .value = value}});
    EXPECT_NEAR(sum_after(frames), healthy, 1e-6) << row_of(kind).name;
  }
}

TEST(PerceptionFaults, RaysHaveTheirOwn) {
  const std::vector<BenchFault> faults{
      {.kind = kLidarOutage, .start = Instant{} + seconds(1), .unit = 2},
      {.kind = kLidarLate, .start = Instant{} + seconds(1), .value = 0.2}};
  EXPECT_EQ(lidar_fault(faults, Instant{}).added_latency, Duration{});
  const LidarFault f = lidar_fault(faults, Instant{} + seconds(1));
  EXPECT_EQ(f.outage, (std::array{false, false, true}));
  EXPECT_EQ(f.added_latency, milliseconds(200));
}

TEST(PerceptionFaults, ACameraThatIsOutSendsNoImages) {
  const std::vector<BenchFault> faults{
      {.kind = kCameraOutage, .start = Instant{} + seconds(1), .unit = 1},
      {.kind = kLidarOutage, .start = Instant{}, .unit = 2}};
  EXPECT_EQ(camera_fault(faults, Instant{}).outage, CameraFault{}.outage);
  EXPECT_EQ(camera_fault(faults, Instant{} + seconds(1)).outage,
            (std::array{false, true, false, false, false}));
}

TEST(PerceptionFaults, AreThoseOfTheCatalogue) {
  EXPECT_TRUE(is_perception_fault(kLidarLate));
  EXPECT_FALSE(is_perception_fault(kGnssLatency));
  EXPECT_EQ(perception_units_of(kLidarOutage), 3U);
  EXPECT_EQ(perception_units_of(kCameraOutage), 5U);
  EXPECT_EQ(perception_units_of(kRadarOutage), 3U);
  EXPECT_EQ(perception_units_of(kDust), 1U);
  EXPECT_FALSE(is_perception_value(kLidarLate, 0.3));
  EXPECT_FALSE(is_perception_value(kLidarLate, 0.0));
  EXPECT_FALSE(is_perception_value(kDust, 1000.0));
}

}  // namespace
}  // namespace pitwall::faults
