// Gate: with a VN-310 as unit 1 the bounds are those of two NovAtels. Alone, the other without a
// solution, it holds that of one bad unit.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "tests/system/localization/scored_run.hpp"

namespace pitwall::bench {
namespace {

constexpr double kUntil_s = kRacing_s + 20.0;

void expect_nominal(const Errors& e) {
  EXPECT_EQ(e.without, 0U);
  EXPECT_GT(e.speed_mean_mps, 60.0);
  EXPECT_LE(e.position_rms_m, 0.03);
  EXPECT_LE(to_deg(e.heading_rms_rad), 0.1);
  EXPECT_LE(e.speed_rms_mps, 0.05);
}

TEST(VectorNav, BesideANovatelTheBoundsAreTheNominalOnes) {
  const ScoredRun run =
      run_scored({.seed = 3, .faults = {}, .until_s = kUntil_s, .vectornav = true});
  print_header();
  print_both("OEM7 and VN-310", run, kRacing_s, kUntil_s);
  expect_nominal(errors_of(run.spatial, kRacing_s, kUntil_s));
}

TEST(VectorNav, AloneItStillHoldsTheOneUnitBound) {
  constexpr double kSilent_s = kRacing_s + 5.0;
  const ScoredRun run = run_scored({.seed = 3,
                                    .faults = {fault("gnss_no_solution", 0, kSilent_s, 60.0)},
                                    .until_s = kUntil_s,
                                    .vectornav = true});
  print_both("VN-310 alone", run, kSilent_s, kUntil_s);
  const Errors e = errors_of(run.spatial, kSilent_s, kUntil_s);
  EXPECT_EQ(e.without, 0U);
  EXPECT_GT(e.speed_mean_mps, 60.0);  // one healthy unit drives on
  EXPECT_LE(e.position_max_m, 0.10);
  EXPECT_LE(e.jump_max_m, 0.05);
}

}  // namespace
}  // namespace pitwall::bench
