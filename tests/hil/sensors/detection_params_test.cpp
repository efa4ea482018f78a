// SPDX-License-Identifier: Apache-2.0
#include "hil/sensors/detection_params.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>
#include <utility>

namespace pitwall::sensors {
namespace {

using world::DetectionSource;

// What the benchmark of tracking stands on: no better than these.
TEST(DetectionParams, TheLidarIsNoBetterThanRealOnes) {
  const DetectionSensor lidar = av21_detection_sensors()[0];
  ASSERT_EQ(lidar.source, DetectionSource::kLidar);
  for (const RangeRow& row : lidar.lidar.position_sigma_m)
    EXPECT_GE(row.value, row.range_m <= 60.0 ? 0.15 : 0.15 + 0.15 * (row.range_m - 60.0) / 40.0);
  EXPECT_GE(lidar.lidar.yaw_sigma_rad, from_deg(2.0));
  EXPECT_LE(lidar.hit_rate[0].value, 0.98);
  EXPECT_GT(lidar.lidar.flip, 0.0);
  EXPECT_GT(lidar.false_per_frame, 0.0);
  EXPECT_GE(lidar.cadence.latency + from_seconds(lidar.cadence.jitter_mean_s), milliseconds(100));
}

TEST(DetectionParams, AFactorScalesEveryNoiseAndNothingElse) {
  const DetectionSensors plain = av21_detection_sensors(), noisy = with_noise(plain, 2.0);
  for (std::size_t i = 0; i < plain.size(); ++i) {
    EXPECT_EQ(noisy[i].lidar.position_sigma_m[1].value,
              2.0 * plain[i].lidar.position_sigma_m[1].value);
    EXPECT_EQ(noisy[i].lidar.yaw_sigma_rad, 2.0 * plain[i].lidar.yaw_sigma_rad);
    EXPECT_EQ(noisy[i].camera.bearing_sigma_rad, 2.0 * plain[i].camera.bearing_sigma_rad);
    EXPECT_EQ(noisy[i].radar.rate_sigma_mps, 2.0 * plain[i].radar.rate_sigma_mps);
    EXPECT_EQ(noisy[i].hit_rate[0].value, plain[i].hit_rate[0].value);
    EXPECT_EQ(noisy[i].lidar.flip, plain[i].lidar.flip);
  }
}

TEST(DetectionParams, WithoutAKindTheOthersAreLeft) {
  const DetectionSensors all = av21_detection_sensors();
  for (const auto source : {DetectionSource::kLidar, DetectionSource::kCamera}) {
    const DetectionSensors kept = without(all, source);
    EXPECT_LT(kept.size(), all.size());
    for (const DetectionSensor& sensor : kept) EXPECT_NE(sensor.source, source);
    EXPECT_EQ(without(kept, source).size(), kept.size());
  }
}

TEST(DetectionParams, TheLidarsDetectorHasTheErrorsThatWereMeasured) {
  const DetectorErrors errors{.rows = {{.from_m = 0.0,
                                        .to_m = 40.0,
                                        .found_share = 0.99,
                                        .position_rms_m = 0.2,
                                        .yaw_rms_rad = 0.03},
                                       {.from_m = 40.0,
                                        .to_m = 100.0,
                                        .found_share = 0.9,
                                        .position_rms_m = 0.4,
                                        .yaw_rms_rad = 0.01}},
                              .false_per_sweep = 0.07};
  const DetectionSensors plain = av21_detection_sensors();
  const DetectionSensors measured = with_detector_errors(plain, errors);
  ASSERT_EQ(measured.size(), plain.size());
  for (std::size_t i = 0; i < measured.size(); ++i) {
    const DetectionSensor& s = measured[i];
    if (s.source != DetectionSource::kLidar) {
      EXPECT_EQ(s.hit_rate[0].value, plain[i].hit_rate[0].value);
      EXPECT_EQ(s.false_per_frame, plain[i].false_per_frame);
      continue;
    }
    ASSERT_EQ(s.hit_rate.size(), 2U);
    EXPECT_EQ(s.hit_rate[1].range_m, 70.0);
    EXPECT_EQ(s.hit_rate[1].value, 0.9);
    // Of two axes, so that the distance is 0.2 m rms.
    EXPECT_NEAR(s.lidar.position_sigma_m[0].value, 0.2 / std::sqrt(2.0), 1e-12);
    EXPECT_NEAR(s.lidar.yaw_sigma_rad, std::sqrt(0.0005), 1e-12);
    EXPECT_EQ(s.false_per_frame, 0.07);
  }
}

TEST(DetectionParams, EachSensorHasItsOwnNumberOfItsKind) {
  std::set<std::pair<DetectionSource, int>> seen;
  for (const DetectionSensor& s : av21_detection_sensors()) {
    EXPECT_TRUE(seen.insert({s.source, s.unit}).second);
    EXPECT_LT(s.view.least_m, s.view.most_m);
    for (std::size_t i = 1; i < s.hit_rate.size(); ++i) {
      EXPECT_GT(s.hit_rate[i].range_m, s.hit_rate[i - 1].range_m);
      EXPECT_LE(s.hit_rate[i].value, s.hit_rate[i - 1].value);
    }
  }
  EXPECT_EQ(seen.size(), 9U);
}

TEST(DetectionParams, TheUnitsOfEachKindAreCounted) {
  std::array<std::size_t, world::kDetectionSources> units{};
  for (const DetectionSensor& sensor : av21_detection_sensors())
    ++units[static_cast<std::size_t>(sensor.source)];
  EXPECT_EQ(units[static_cast<std::size_t>(DetectionSource::kCamera)], kCameraUnits);
  EXPECT_EQ(units[static_cast<std::size_t>(DetectionSource::kRadar)], kRadarUnits);
}

}  // namespace
}  // namespace pitwall::sensors
