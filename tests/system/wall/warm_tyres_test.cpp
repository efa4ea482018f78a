// The tyres of the whole car on Las Vegas at 147 mph, by the plant's unvalidated law: they warm,
// hold the window in which the planner and the base's gate count on all their grip, and cool behind
// a pace car.
//
// The bound on warming was fixed before the first run, by the one public figure of this car's
// tyres: a recorded AV-21 took its front left one from 31 to 53 C in about 10 min, at up to 48 m/s
// (PITT-MIT-IAC betty data set, 2023-06-18). 10 min are 16 laps at 147 mph.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "hil/bench/loading.hpp"
#include "hil/bench/lockstep/lockstep.hpp"
#include "hil/plant/tyre_thermal.hpp"
#include "tests/system/wall/wall_watch.hpp"

namespace pitwall {
namespace {

constexpr double kLapsToWarm = 16.0, kLapsHeld = 12.0;
constexpr double kWindowLow_c = 75.0, kWindowHigh_c = 100.0;

double coldest_c(const bench::Rig& rig) { return *std::ranges::min_element(rig.truth().tyre_c); }
double hottest_c(const bench::Rig& rig) { return *std::ranges::max_element(rig.truth().tyre_c); }

// The flying laps without their end.
bench::Loaded laps(double tyres_c) {
  const std::string root = PITWALL_SOURCE_DIR;
  auto loaded = bench::load(root + "/hil/scenarios/lvms_flying_lap.yaml", root);
  if (!loaded) ADD_FAILURE() << to_string(loaded.error());
  loaded->scenario.expect.clear();
  loaded->scenario.race_control.pop_back();
  loaded->scenario.duration = seconds(1800);
  loaded->scenario.tyres.temperature_c = tyres_c;
  return *std::move(loaded);
}

double laps_of(const bench::Loaded& loaded, const bench::Rig& rig) {
  return rig.truth().odometer_m / loaded.setup.track.length_m();
}

TEST(WarmTyres, FromColdTheyAreWarmWithinTheLapsOfThePublicFigure) {
  const bench::Loaded loaded = laps(30.0);
  bool warm = false, over = false;
  double driven = 0.0;
  bench::LockstepOptions options;
  options.watch = [&](const pipeline::Outputs&, const bench::Rig& rig, Instant) {
    driven = laps_of(loaded, rig);
    warm = coldest_c(rig) >= kWindowLow_c;
    over = warm || driven > kLapsToWarm;
    EXPECT_LE(hottest_c(rig), kWindowHigh_c);
  };
  options.over = [&](const auto&) { return over; };
  ASSERT_TRUE(bench::run_lockstep(loaded.scenario, loaded.setup, options));
  std::printf("all four at %.0f C after %.1f laps\n", kWindowLow_c, driven);
  EXPECT_TRUE(warm) << driven << " laps";
  EXPECT_GT(driven, 2.0) << "no tyre is warm at once";
}

TEST(WarmTyres, AtRacingSpeedTheyHoldTheWindowAndTheWallHasNoAlarm) {
  const bench::Loaded loaded = laps(85.0);
  WallWatch wall;
  double low_c = 1e9, high_c = -1e9, driven = 0.0;
  bench::LockstepOptions options;
  options.watch = [&](const pipeline::Outputs&, const bench::Rig& rig, Instant) {
    driven = laps_of(loaded, rig);
    low_c = std::min(low_c, coldest_c(rig));
    high_c = std::max(high_c, hottest_c(rig));
  };
  wall.listen(options);
  options.over = [&](const auto&) { return driven > kLapsHeld + 1.0; };  // the first is from rest
  ASSERT_TRUE(bench::run_lockstep(loaded.scenario, loaded.setup, options));
  std::printf("%.0f laps at 147 mph: %.1f to %.1f C\n", kLapsHeld, low_c, high_c);
  EXPECT_GT(driven, kLapsHeld + 1.0);
  EXPECT_GE(low_c, kWindowLow_c);
  EXPECT_LE(high_c, kWindowHigh_c);
  EXPECT_EQ(wall.alarms(), std::set<std::string>{});
}

TEST(WarmTyres, BehindAPaceCarTheyCoolByTensOfDegreesInMinutesAndLoseGrip) {
  bench::Loaded loaded = laps(85.0);
  loaded.scenario.duration = seconds(320);
  loaded.scenario.race_control.back().round_target_speed_mph = 65.0;  // of the pace car of 2022
  double before_c = 1e9, at_minute_c = kUnset;
  bench::LockstepOptions options;
  options.watch = [&](const pipeline::Outputs&, const bench::Rig& rig, Instant at) {
    if (at < Instant{} + seconds(30)) return;
    EXPECT_LT(coldest_c(rig), before_c + 0.05) << "at " << (at - Instant{}).seconds();
    before_c = std::min(before_c, coldest_c(rig));
    if (at == Instant{} + seconds(80)) at_minute_c = before_c;
  };
  ASSERT_TRUE(bench::run_lockstep(loaded.scenario, loaded.setup, options));
  std::printf("behind a pace car: 85 C, %.1f C after a minute, %.1f C after 5\n", at_minute_c,
              before_c);
  EXPECT_GT(at_minute_c, 65.0);
  EXPECT_LT(at_minute_c, 82.0);
  EXPECT_LT(before_c, 65.0);
  EXPECT_LT(plant::thermal_grip(loaded.scenario.plant.thermal, before_c), 0.95);
}

}  // namespace
}  // namespace pitwall
