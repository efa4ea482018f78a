// SPDX-License-Identifier: Apache-2.0
#include "vehicle/pipeline/tick_log.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace pitwall::pipeline {
namespace {

constexpr Instant kLogStart{1'000'000'000};
constexpr double kLength_m = 2'000.0;

struct Driver {
  LapClock clock;
  Instant now = kLogStart;
  double driven_m = 0.0;

  void drive(double metres, double speed_mps) {
    const double end_m = driven_m + metres;
    while (driven_m < end_m) {
      now += milliseconds(10);
      driven_m += 0.01 * speed_mps;
      clock.advance(std::fmod(driven_m, kLength_m), kLength_m, now);
    }
  }
};

TEST(LapClock, TimesWholeLapsFromLineToLineBetweenTheTicks) {
  Driver car;
  car.driven_m = 1'234.0;
  car.drive(kLength_m, 73.0);  // crosses the line once
  EXPECT_TRUE(std::isnan(car.clock.last_lap_s()));
  car.drive(kLength_m, 73.0);
  EXPECT_NEAR(car.clock.last_lap_s(), kLength_m / 73.0, 1e-6);
  car.drive(kLength_m - 766.0, 73.0);
  car.drive(2.0 * kLength_m, 50.0);
  EXPECT_NEAR(car.clock.last_lap_s(), kLength_m / 50.0, 1e-6);
}

TEST(LapClock, ACarThatGoesBackAcrossTheLineOrJumpsTimesNoLap) {
  LapClock clock;
  Instant now = kLogStart;
  const auto at = [&](double station_m) {
    clock.advance(station_m, kLength_m, now += milliseconds(10));
  };
  for (int round = 0; round < 3; ++round) {
    at(1'999.5);
    at(0.5);  // forward
    at(1'999.5);
    at(1'900.0);  // a jump
    at(1'960.0);
  }
  EXPECT_TRUE(std::isnan(clock.last_lap_s()));
  at(kUnset);  // lost
  at(1'999.0);
  at(1.0);
  EXPECT_TRUE(std::isnan(clock.last_lap_s()));
}

TEST(TickLog, KeepsTheNewestOfEachUnitAndIgnoresUnitsThatThereAreNot) {
  TickLog log;
  world::SensorInput sensors;
  (void)sensors.positions.push({.unit = 1, .at = kLogStart, .satellites = 9});
  (void)sensors.positions.push({.unit = 1, .at = kLogStart, .satellites = 11});
  (void)sensors.positions.push({.unit = 2, .at = kLogStart, .satellites = 99});
  (void)sensors.imu.push({.unit = 200, .at = kLogStart});
  log.note({.now = kLogStart, .can = {}, .sensors = sensors, .requests = {}}, {}, kLength_m);
  EXPECT_FALSE(log.position(0).has_value());
  ASSERT_TRUE(log.position(1).has_value());
  EXPECT_EQ(log.position(1)->satellites, 11);
  EXPECT_FALSE(log.imu().has_value());
  EXPECT_EQ(log.at(), kLogStart);
}

}  // namespace
}  // namespace pitwall::pipeline
