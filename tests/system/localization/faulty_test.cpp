// Gates: one receiver is bad, both are out, and both are back. The car drives at 68 m/s on the
// banking of Las Vegas; what the planar filter of the paper makes of it is printed beside.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdio>
#include <string>

#include "tests/system/localization/scored_run.hpp"

namespace pitwall::bench {
namespace {

constexpr double kFault_s = kRacing_s + 4.0;  // into turns 1 and 2
constexpr double kBad_s = 6.0, kAfter_s = 3.0;

struct BadUnit {
  const char* what;
  const char* kind;
  double value;
};

// Each kind for a while on unit 0, then on unit 1, in one run.
void expect_rides_through(const BadUnit& bad) {
  const double again_s = kFault_s + kBad_s + kAfter_s;
  const double until_s = again_s + kBad_s + kAfter_s;
  for (std::uint64_t seed = 1; seed <= seeds(1); ++seed) {
    const ScoredRun run = run_scored({.seed = seed,
                                      .faults = {fault(bad.kind, 0, kFault_s, kBad_s, bad.value),
                                                 fault(bad.kind, 1, again_s, kBad_s, bad.value)},
                                      .until_s = until_s});
    print_both(std::string(bad.what) + ", seed " + std::to_string(seed), run, kFault_s, until_s);
    const Errors e = errors_of(run.spatial, kFault_s, until_s);
    EXPECT_EQ(e.without, 0U);
    EXPECT_LE(e.position_max_m, 0.10) << bad.what << ", seed " << seed;
    EXPECT_LE(e.jump_max_m, 0.05) << bad.what << ", seed " << seed;
    EXPECT_GT(e.speed_mean_mps, 60.0) << "one unit is enough to go on";
  }
}

TEST(OneUnitBad, SteppedToTheLeft) {
  print_header();
  expect_rides_through({"0.3 m to the left", "gnss_position_jump_left", 0.3});
}

TEST(OneUnitBad, SteppedAhead) {
  expect_rides_through({"0.3 m ahead", "gnss_position_jump_ahead", 0.3});
}

TEST(OneUnitBad, VarianceJumps) {
  expect_rides_through({"variance x 2500", "gnss_variance_spike", 50.0});
}

TEST(OneUnitBad, FloatsAndComesBack) {
  expect_rides_through({"RTK lost", "gnss_rtk_lost", kUnset});
}

TEST(OneUnitBad, DriftsAway) {
  expect_rides_through({"drifts 0.1 m/s", "gnss_position_drift", 0.1});
}

// What the test would see if nobody judged: the same step, and the checks that refuse it are off.
TEST(OneUnitBad, IsSeenWhereNobodyRefusesIt) {
  const double until_s = kFault_s + kBad_s;
  world::MonitorSet off;
  off.add(world::Monitor::kInnovation);
  off.add(world::Monitor::kUnitAgreement);
  const ScoredRun run =
      run_scored({.seed = 1,
                  .faults = {fault("gnss_position_jump_left", 0, kFault_s, kBad_s, 0.3)},
                  .until_s = until_s,
                  .vectornav = false,
                  .off = off});
  print_both("0.3 m to the left, no checks", run, kFault_s, until_s);
  EXPECT_GT(errors_of(run.spatial, kFault_s, until_s).position_max_m, 0.10);
}

// `kind` says what is missing: satellites alone, or the inertial units as well.
void expect_bridges(const char* kind, double out_s, double limit_m) {
  for (std::uint64_t seed = 1; seed <= seeds(2); ++seed) {
    // At two places: into the turn, and out of it.
    for (const double from_s : {kFault_s, kFault_s + 7.0}) {
      const double back_s = from_s + out_s, until_s = back_s + 5.0;
      const ScoredRun run =
          run_scored({.seed = seed,
                      .faults = {fault(kind, 0, from_s, out_s), fault(kind, 1, from_s, out_s)},
                      .until_s = until_s});
      const std::string what = std::string(kind) + ' ' + std::to_string(static_cast<int>(out_s)) +
                               " s from " + std::to_string(static_cast<int>(from_s)) + " s, seed " +
                               std::to_string(seed);
      print_both(what, run, from_s, back_s);
      print_both("  back", run, back_s, until_s);
      EXPECT_LE(errors_of(run.spatial, from_s, back_s).position_max_m, limit_m) << what;
      EXPECT_LE(errors_of(run.spatial, back_s, until_s).jump_max_m, 0.05) << what;
    }
  }
}

TEST(BothOut, ForTwoSeconds) {
  print_header();
  expect_bridges("gnss_no_solution", 2.0, 0.5);
}

TEST(BothOut, ForFiveSeconds) { expect_bridges("gnss_no_solution", 5.0, 1.5); }

// Without IMU: wheels, steering and the road are all that is left. The car stops by its own rule;
// how far it knows the way is what is scored; the limits are what it does, not what one wishes.
TEST(BothSilent, ForTwoSeconds) {
  print_header();
  expect_bridges("gnss_unit_outage", 2.0, 2.0);
}

TEST(BothSilent, ForFiveSeconds) { expect_bridges("gnss_unit_outage", 5.0, 8.0); }

}  // namespace
}  // namespace pitwall::bench
