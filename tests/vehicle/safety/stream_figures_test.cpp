// SPDX-License-Identifier: Apache-2.0
// Rate, gap and latency of the watchdog's rows.
#include <gtest/gtest.h>

#include <cmath>

#include "vehicle/safety/watchdog.hpp"

namespace pitwall::safety {
namespace {

// One receiver whose positions come as it is told, one tick at a time.
struct Receiver {
  WatchdogParams params;
  WatchdogState state;
  world::SensorUse use;
  Instant now = Instant{} + seconds(50);
  std::int64_t tick = 0;
  int every = 5;  // ticks: 20 Hz
  Duration late = milliseconds(30);

  WatchdogOutput step() {
    now += milliseconds(10);
    world::SensorInput sensors;
    if (++tick % every == 0) {
      EXPECT_TRUE(sensors.positions.push({.unit = 0,
                                          .at = now - late,
                                          .solution_status = world::kSolutionComputed,
                                          .position_type = world::kPositionNarrowInt,
                                          .latitude_sigma_m = 0.01,
                                          .longitude_sigma_m = 0.02}));
    }
    const world::VehicleSignals signals;
    const world::RaceControl race;
    return watch(params, state,
                 {.sensors = sensors,
                  .signals = signals,
                  .race_control = race,
                  .planner_at = {},
                  .radio_at = {},
                  .use = use},
                 now);
  }
  StreamRow run(Duration span) {
    StreamRow row;
    for (const Instant end = now + span; now < end;) row = step()[Stream::kGnss0Position];
    return row;
  }
};

TEST(StreamFigures, SayWhatCameInTheLastSecond) {
  Receiver r;
  const StreamRow young = r.run(milliseconds(900));
  EXPECT_TRUE(std::isnan(young.rate_hz)) << "not before there was one";
  const StreamRow row = r.run(seconds(3));
  EXPECT_NEAR(row.rate_hz, 20.0, 1e-9);
  EXPECT_EQ(row.gap, milliseconds(50));
  EXPECT_EQ(row.latency, milliseconds(30));
  EXPECT_EQ(row.health, Health::kGood);
}

TEST(StreamFigures, EachRateHasItsGrade) {
  for (const auto& [every, health] : {std::pair{5, Health::kGood},
                                      {6, Health::kGood},
                                      {8, Health::kWarning},
                                      {12, Health::kWarning},
                                      {20, Health::kBad}}) {
    Receiver r;
    r.every = every;
    r.params[Stream::kGnss0Position].warning = milliseconds(400);  // the rate alone
    EXPECT_EQ(r.run(seconds(4)).health, health) << every;
  }
}

TEST(StreamFigures, ADelayIsGradedAndPassesAfterASecond) {
  Receiver r;
  r.run(seconds(3));
  r.late = milliseconds(121);
  EXPECT_EQ(r.run(milliseconds(300)).health, Health::kWarning);
  r.late = milliseconds(301);
  EXPECT_EQ(r.run(milliseconds(500)).health, Health::kBad);
  r.late = milliseconds(30);
  EXPECT_EQ(r.run(milliseconds(1300)).health, Health::kGood);
}

TEST(StreamFigures, AGapThatIsOverIsNoMoreThanAWarning) {
  Receiver r;
  r.run(seconds(3));
  r.every = 1'000'000;
  r.run(milliseconds(450));
  r.every = 5;
  const StreamRow row = r.run(milliseconds(300));
  EXPECT_GE(row.gap, milliseconds(450));
  EXPECT_EQ(row.health, Health::kWarning);
  EXPECT_EQ(r.run(milliseconds(1300)).health, Health::kGood);
}

TEST(StreamFigures, TheCarsOwnSleepIsNoDelayOfTheSensor) {
  Receiver r;
  r.run(seconds(3));
  world::SensorInput sensors;
  EXPECT_TRUE(sensors.positions.push({.unit = 0, .at = r.now - milliseconds(25)}));
  r.now += milliseconds(400);
  const world::VehicleSignals signals;
  const world::RaceControl race;
  watch(r.params, r.state,
        {.sensors = sensors,
         .signals = signals,
         .race_control = race,
         .planner_at = {},
         .radio_at = {}},
        r.now);
  const StreamRow row = r.run(milliseconds(300));
  EXPECT_LE(row.latency, milliseconds(30));
  EXPECT_NE(row.health, Health::kBad);
}

TEST(StreamFigures, TheAccuracyIsTheBestOfTheLastThree) {
  Receiver r;
  EXPECT_TRUE(std::isnan(r.step().sigma_m[0]));
  r.run(seconds(1));
  const WatchdogOutput out = r.step();
  EXPECT_EQ(out.sigma_m[0], 0.02) << "the worse of latitude and longitude";
  EXPECT_TRUE(std::isnan(out.sigma_m[1]));
  for (const double bad : {kUnset, -1.0}) {
    for (int i = 1; i <= 3; ++i) {
      world::SensorInput sensors;
      EXPECT_TRUE(sensors.positions.push(
          {.unit = 0, .at = r.now, .latitude_sigma_m = bad, .longitude_sigma_m = 0.01}));
      r.now += milliseconds(10);
      const world::VehicleSignals signals;
      const world::RaceControl race;
      const WatchdogOutput now = watch(r.params, r.state,
                                       {.sensors = sensors,
                                        .signals = signals,
                                        .race_control = race,
                                        .planner_at = {},
                                        .radio_at = {}},
                                       r.now);
      EXPECT_EQ(std::isinf(now.sigma_m[0]), i == 3) << bad;
    }
    r.run(seconds(1));
  }
}

TEST(StreamFigures, WhatTheOperatorExcludedIsNotWatchedAndSeenByNobody) {
  Receiver r;
  r.run(seconds(3));
  r.every = 1'000'000;
  r.run(seconds(2));
  EXPECT_TRUE(r.step().seen.has(world::Monitor::kStreamAge));
  EXPECT_EQ(r.step()[Stream::kGnss0Position].health, Health::kBad);
  r.use.excluded = 1;
  const WatchdogOutput out = r.step();
  for (const Stream s : {Stream::kGnss0Link, Stream::kGnss0Position, Stream::kGnss0Solution})
    EXPECT_EQ(out[s].health, Health::kUnwatched);
  EXPECT_EQ(out[Stream::kGnss1Position].health, Health::kNever);
  EXPECT_TRUE(out.seen.empty());
  r.use.excluded = 0;
  r.params.off.add(world::Monitor::kStreamAge);
  EXPECT_TRUE(r.step().seen.empty()) << "a monitor that is off sees nothing";
}

}  // namespace
}  // namespace pitwall::safety
