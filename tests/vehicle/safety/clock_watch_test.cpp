// SPDX-License-Identifier: Apache-2.0
#include "vehicle/safety/clock_watch.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/vehicle/safety/situation.hpp"

namespace pitwall::safety {
namespace {

// Two receivers at 20 Hz over a line that adds 1 to 12 ms; the car's clock is off by what is said.
struct Clocks {
  ClockParams params;
  ClockState state;
  Random random{1};
  Instant now = Instant{} + seconds(100);  // true time
  double fast_ppm = 0.0;                   // of the car's clock
  std::int64_t car_step_ns = 0, utc_offset_s = -18;
  std::array<std::int64_t, world::kGnssUnits> unit_step_ns{};
  std::array<bool, world::kGnssUnits> sends{true, true};
  ClockOutput out;

  Instant on_the_car(Instant at) const {
    const auto drift = static_cast<double>((at - Instant{}).ns) * fast_ppm * 1e-6;
    return at + nanoseconds(static_cast<std::int64_t>(drift) + car_step_ns);
  }
  const ClockOutput& tick() {
    now += milliseconds(50);
    world::SensorInput sensors;
    for (std::uint8_t unit = 0; unit < world::kGnssUnits; ++unit) {
      if (!sends[unit]) continue;
      const Duration late = microseconds(1'000 + static_cast<std::int64_t>(random.below(11'000)));
      const std::int64_t gps_ns = 1'400'000'000'000'000'000 + now.ns + unit_step_ns[unit];
      EXPECT_TRUE(sensors.times.push({.unit = unit,
                                      .received = on_the_car(now + late),
                                      .gps_ns = gps_ns,
                                      .utc_offset_s = static_cast<double>(utc_offset_s)}));
    }
    return out = watch_clock(params, state, sensors, on_the_car(now + milliseconds(15)));
  }
  // Whether it was ever said within the span.
  std::array<bool, 2> run(Duration span) {
    std::array<bool, 2> stated{};
    for (const Instant end = now + span; now < end;) {
      tick();
      stated[0] = stated[0] || out.stepped;
      stated[1] = stated[1] || out.skewed;
    }
    return stated;
  }
};

TEST(ClockWatch, ClocksThatAgreeSayNothingForTenMinutes) {
  for (const double ppm : {-30.0, 0.0, 30.0}) {
    Clocks c;
    c.fast_ppm = ppm;
    const auto stated = c.run(seconds(600));
    EXPECT_FALSE(stated[0]) << ppm;
    EXPECT_FALSE(stated[1]) << ppm;
    EXPECT_NEAR(c.out.skew_ppm, ppm, 25.0);
  }
}

TEST(ClockWatch, ASkewOfAHundredIsToldWithinFortySeconds) {
  for (const double ppm : {-100.0, 100.0}) {
    Clocks c;
    const Instant began = c.now;
    c.fast_ppm = ppm;
    while (!c.tick().skewed) ASSERT_LT(c.now - began, seconds(41));
    EXPECT_NEAR(c.out.skew_ppm, ppm, 25.0);
    EXPECT_FALSE(c.run(seconds(60))[0]) << "a skew is no step";
  }
}

TEST(ClockWatch, AStepOfTheCarsClockEitherWayIsToldAtOnceAndForAWhile) {
  for (const std::int64_t ms : {-1000, -150, 150, 1000}) {
    Clocks c;
    c.run(seconds(20));
    c.car_step_ns = ms * 1'000'000;
    const Instant began = c.now;
    while (!c.tick().stepped) ASSERT_LT(c.now - began, milliseconds(200)) << ms;
    EXPECT_NEAR(c.out.step_s, static_cast<double>(ms) * 1e-3, 0.015);
    EXPECT_LE(c.now - began, ms < 0 ? milliseconds(50) : milliseconds(150));
    EXPECT_TRUE(c.run(milliseconds(800))[0]);
    c.run(seconds(1));
    EXPECT_FALSE(c.run(seconds(60))[0]) << "once is enough";
    EXPECT_EQ(c.state.steps, 2u) << "by each receiver";
  }
}

TEST(ClockWatch, AStepOfOneReceiverIsToldToo) {
  Clocks c;
  c.run(seconds(20));
  c.unit_step_ns[1] = 1'000'000'000;
  EXPECT_TRUE(c.run(milliseconds(200))[0]);
  EXPECT_NEAR(c.out.step_s, -1.0, 0.015) << "the car seems to be late";
  EXPECT_EQ(c.state.steps, 1u);
}

TEST(ClockWatch, ALeapSecondIsAStepOfTheOffset) {
  Clocks c;
  c.run(seconds(5));
  c.utc_offset_s = -19;
  EXPECT_TRUE(c.tick().stepped);
  EXPECT_EQ(c.out.step_s, -1.0);
}

// A car that was paused receives what waited, each message a little less late.
TEST(ClockWatch, WhatWaitedWhileTheCarSleptIsNoStep) {
  Clocks c;
  c.run(seconds(20));
  const Instant woke = c.now + milliseconds(500);
  world::SensorInput sensors;
  for (; c.now < woke; c.now += milliseconds(50))
    if (!sensors.times.push({.unit = 0,
                             .received = woke,
                             .gps_ns = 1'400'000'000'000'000'000 + c.now.ns,
                             .utc_offset_s = -18.0}))
      break;
  EXPECT_FALSE(watch_clock(c.params, c.state, sensors, woke).stepped);
  EXPECT_FALSE(c.run(seconds(10))[0]);
}

TEST(ClockWatch, AUnitThatSaysNothingHasNoSayAndAStrangerIsIgnored) {
  Clocks c;
  c.sends = {false, false};
  EXPECT_FALSE(c.run(seconds(60))[0]);
  EXPECT_TRUE(std::isnan(c.out.skew_ppm));
  world::SensorInput sensors;
  EXPECT_TRUE(sensors.times.push({.unit = 7, .received = c.now, .gps_ns = 5, .utc_offset_s = 0.0}));
  watch_clock(c.params, c.state, sensors, c.now);
  EXPECT_FALSE(c.state.units[0].started || c.state.units[1].started);
}

}  // namespace
}  // namespace pitwall::safety
