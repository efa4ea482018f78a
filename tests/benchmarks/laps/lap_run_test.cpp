// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/laps/lap_run.hpp"

#include <gtest/gtest.h>

#include "tests/benchmarks/laps/shipped_scenario.hpp"

namespace pitwall::laps {
namespace {

const bench::Loaded& texas() {
  static const bench::Loaded loaded = shipped_scenario("tms_flying_lap");
  return loaded;
}

LapRow drive(const scenario::Scenario& scenario) {
  const auto row = run_laps(scenario, texas().setup);
  EXPECT_TRUE(row);
  return row ? *row : LapRow{};
}

scenario::Scenario with_fault(const char* kind, double value) {
  scenario::Scenario s = texas().scenario;
  s.faults = {
      {.kind = kind, .at = seconds(55), .lasts = seconds(100), .value = value, .place = "test"}};
  s.duration = seconds(100);
  return s;
}

TEST(LapRun, ACarThatIsAsItBelievesLaps) {
  const LapRow row = drive(texas().scenario);
  EXPECT_EQ(row.outcome, Outcome::kLapped);
  EXPECT_GE(row.flying, 2u);
  EXPECT_GT(row.flying_mean_mps, 55.0);
  EXPECT_LE(row.flying_mean_mps, row.speed_max_mps);
  EXPECT_LT(row.cross_track.overall.max_m, 1.4) << "the paper's maximum";
  EXPECT_LT(row.slip_max_rad, 0.1);
}

// A wall ends the figures: what a model says of a car in a wall is no cross-track error.
TEST(LapRun, ACarWithoutGripLeavesAtAStatedPlace) {
  const LapRow row = drive(with_fault("low_grip", 0.35));
  EXPECT_EQ(row.outcome, Outcome::kContact);
  EXPECT_GT(row.at_s, 55.0);
  EXPECT_GE(row.station_m, 0.0);
  EXPECT_LT(row.station_m, texas().setup.track.length_m());
  EXPECT_GT(row.speed_mps, 20.0);
  const auto& all = row.cross_track;
  EXPECT_NEAR(static_cast<double>(all.overall.samples + all.slow), 100.0 * row.at_s, 2.0);
  EXPECT_LT(all.overall.max_m, 12.0) << "no farther than the walls";
}

TEST(LapRun, ACarThatStopsItselfSaysWhyAndWhere) {
  const LapRow row = drive(with_fault("race_heartbeat_stop", kUnset));
  EXPECT_EQ(row.outcome, Outcome::kStopped);
  EXPECT_FALSE(row.cause.empty());
  EXPECT_GT(row.at_s, 55.0);
  EXPECT_LT(row.at_s, 70.0) << "the limit on race control is about ten seconds";
}

TEST(LapRun, ARunThatIsTooShortHasNoVerdict) {
  scenario::Scenario s = texas().scenario;
  s.duration = seconds(30);
  s.expect.clear();
  EXPECT_EQ(drive(s).outcome, Outcome::kUnfinished);
}

TEST(LapRun, TheSameRunIsKnownAndAnotherIsNot) {
  scenario::Scenario s = texas().scenario;
  s.duration = seconds(45);
  s.expect.clear();
  const LapRow first = drive(s);
  EXPECT_TRUE(same_run(first, drive(s)));
  s.perturb.mass_kg = 1.0;
  EXPECT_FALSE(same_run(first, drive(s)));
}

}  // namespace
}  // namespace pitwall::laps
