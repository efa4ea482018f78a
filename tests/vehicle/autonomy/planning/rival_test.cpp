// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/planning/rival.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/vehicle/autonomy/planning/stadium.hpp"

namespace pitwall::planning {
namespace {

constexpr RivalParams kReach{.watch_ahead_m = 150.0, .watch_behind_m = 80.0, .forget_s = 3.0};

struct Road {
  world::TrackMap track = testing::stadium();
  OwnPlace own{.track_s_m = 10.0, .speed_mps = 50.0};
  world::Opponents cars;
  Instant now = Instant{} + seconds(10);
  Rival rival;

  void add(std::uint32_t id, double s_m, double n_m, double speed_mps) {
    const double station_m = track.wrap_station(s_m);
    world::Opponent car;
    car.id = id, car.s_m = station_m, car.n_m = n_m, car.speed_mps = speed_mps;
    car.yaw_rad = track.at(station_m).yaw_rad;
    car.measured_at = now;
    CHECK(cars.cars.push(car));
  }
  const Rival& step() {
    rival = follow(kReach, rival, track, own, cars, now);
    now += milliseconds(50);
    cars = {};
    return rival;
  }
};

TEST(Rival, TheGapIsTheShorterWayAround) {
  Road road;
  road.add(1, road.own.track_s_m - 30.0, 3.0, 40.0);  // behind us, across the start of the lap
  EXPECT_NEAR(road.step().gap_m, 30.0, 1e-6);
  EXPECT_NEAR(road.rival.speed_mps, 40.0, 1e-9);
  road.add(1, road.own.track_s_m + 45.0, 3.0, 40.0);
  EXPECT_NEAR(road.step().gap_m, -45.0, 1e-6);
}

TEST(Rival, StaysTheSameWhileItIsInReachThoughAnotherComesNearer) {
  Road road;
  road.add(1, 100.0, 3.0, 40.0);
  EXPECT_EQ(road.step().id, 1u);
  road.add(1, 100.0, 3.0, 40.0), road.add(2, 40.0, 3.0, 40.0);
  EXPECT_EQ(road.step().id, 1u);
  road.add(1, 400.0, 3.0, 40.0), road.add(2, 40.0, 3.0, 40.0);
  EXPECT_EQ(road.step().id, 2u);
}

TEST(Rival, ANewNumberAtTheSamePlaceIsTheSameCar) {
  Road road;
  road.add(1, 100.0, 3.0, 40.0), road.add(3, 30.0, -3.0, 40.0);
  road.rival = follow(kReach,
                      {.known = true,
                       .id = 1,
                       .gap_m = -90.0,
                       .n_m = 3.0,
                       .speed_mps = 40.0,
                       .at = road.now,
                       .measured_at = road.now},
                      road.track, road.own, road.cars, road.now);
  road.cars = {};
  road.add(7, 100.5, 3.1, 40.0), road.add(3, 30.0, -3.0, 40.0);
  EXPECT_EQ(road.step().id, 7u);
}

TEST(Rival, OutOfSightItGoesOnAndIsForgottenInTime) {
  Road road;
  road.add(1, 60.0, 3.0, 40.0);
  const Instant seen = road.now;
  road.step();
  while ((road.now - seen).seconds() <= 3.0) {
    road.step();
    ASSERT_TRUE(road.rival.known);
    const double gone_s = (road.rival.at - seen).seconds();
    EXPECT_NEAR(road.rival.gap_m, -50.0 + 10.0 * gone_s, 1e-6);
  }
  road.step();
  EXPECT_FALSE(road.rival.known);
}

TEST(Rival, ATrackOfTwoFalseDetectionsIsNone) {
  Road road;
  road.add(1, 60.0, 3.0, 0.0);
  road.cars.cars[0].born_at = road.now - milliseconds(100);
  EXPECT_FALSE(road.step().known);
  road.add(1, 60.0, 3.0, 0.0);
  road.cars.cars[0].born_at = road.now - milliseconds(250);
  EXPECT_TRUE(road.step().known);
}

TEST(Rival, WhatHasNoPlaceIsNone) {
  for (double world::Opponent::*field : {&world::Opponent::s_m, &world::Opponent::n_m,
                                         &world::Opponent::speed_mps, &world::Opponent::yaw_rad}) {
    Road road;
    road.add(1, 60.0, 3.0, 40.0);
    road.cars.cars[0].*field = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(road.step().known);
  }
}

}  // namespace
}  // namespace pitwall::planning
