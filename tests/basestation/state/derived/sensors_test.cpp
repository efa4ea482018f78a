// SPDX-License-Identifier: Apache-2.0
#include "basestation/state/derived/sensors.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/basestation/known_state.hpp"

namespace pitwall::state {
namespace {

void publish(KnownState& reported, const SensorRow& row, double rate, double gap, double latency) {
  reported.publish(row.rate, rate, kStart);
  reported.publish(row.gap, gap, kStart);
  reported.publish(row.latency, latency, kStart);
}

TEST(Sensors, TheWorstOfEachCounts) {
  KnownState reported;
  for (const SensorRow& row : kSensorTable) {
    publish(reported, row, row.nominal_hz, 60.0, row.latency_allowed_ms / 2.0);
  }
  EXPECT_NEAR(worst_sensor(reported.vehicle, kStart).rate_share, 1.0, 1e-12);
  EXPECT_NEAR(worst_sensor(reported.vehicle, kStart).latency_share, 0.5, 1e-12);
  // The paper's LiDAR under load: 5 Hz instead of 20, gaps above half a second, each frame young.
  publish(reported, kSensorTable[4], 5.0, 520.0, 50.0);
  const SensorHealth worst = worst_sensor(reported.vehicle, kStart);
  EXPECT_NEAR(worst.rate_share, 0.25, 1e-12);
  EXPECT_EQ(worst.gap_ms, 520.0);
  EXPECT_NEAR(worst.latency_share, 0.5, 1e-12);
}

TEST(Sensors, OneThatNeverCameIsNotJudged) {
  KnownState reported;
  EXPECT_TRUE(std::isnan(worst_sensor(reported.vehicle, kStart).rate_share));
  publish(reported, kSensorTable[0], 20.0, 60.0, 10.0);
  EXPECT_NEAR(worst_sensor(reported.vehicle, kStart).rate_share, 1.0, 1e-12);
  publish(reported, kSensorTable[0], 0.0, 1'000.0, 10.0);  // but one that is silent now is
  EXPECT_EQ(worst_sensor(reported.vehicle, kStart).rate_share, 0.0);
}

TEST(Sensors, ACameraIsOffByTheWorseOfBearingAndDistance) {
  using telemetry::field;
  KnownState reported;
  EXPECT_TRUE(std::isnan(worst_camera_offset(reported.vehicle, kStart))) << "nothing is known";
  reported.publish(field("sensors.camera0_bearing_bias"), -0.0025, kStart);
  EXPECT_NEAR(worst_camera_offset(reported.vehicle, kStart), 0.5, 1e-9);
  reported.publish(field("sensors.camera1_distance_ratio"), 0.7, kStart);
  EXPECT_NEAR(worst_camera_offset(reported.vehicle, kStart), 2.0, 1e-9);
}

}  // namespace
}  // namespace pitwall::state
