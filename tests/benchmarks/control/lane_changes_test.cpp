// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/control/lane_changes.hpp"

#include <gtest/gtest.h>

#include "tests/benchmarks/laps/lap_plan.hpp"
#include "tests/benchmarks/laps/shipped_scenario.hpp"

namespace pitwall::control_bench {
namespace {

// A minute at one speed: there and back seven times, and not once more.
TEST(LaneChanges, TheCarGoesToTheLaneBesideAndBack) {
  const bench::Loaded on = laps::shipped_scenario("ims_flying_lap");
  Plan plan = lane_change_plan(on.scenario);
  plan.windows.resize(1);
  plan.scenario.duration = plan.windows.back().until;
  const auto row = run_lane_changes(plan, on.setup);
  ASSERT_TRUE(row) << to_string(row.error());
  EXPECT_EQ(row->end, "");
  EXPECT_EQ(row->changes, 8U);
  EXPECT_NEAR(static_cast<double>(row->error.samples), 8 * 500.0, 120.0);
  EXPECT_GT(row->error.max_m, 0.0);
  EXPECT_LT(row->error.max_m, 1.5) << "half of the way from lane to lane";
}

TEST(LaneChanges, ATrackWithoutRoomForASecondLaneIsRefused) {
  bench::Loaded on = laps::shipped_scenario("ims_flying_lap");
  on.setup.params.planning.line.wall_clearance_m = 9.0;
  EXPECT_FALSE(run_lane_changes(lane_change_plan(on.scenario), on.setup));
}

LaneChangeRow row(const char* world, const char* law, double mean_m, double max_m) {
  return {.track = "OVAL",
          .world = world,
          .law = law,
          .error = {.samples = 100, .sum_m = 100.0 * mean_m, .max_m = max_m},
          .changes = 7,
          .end = {}};
}

TEST(LaneChanges, OurLawIsJudgedInEveryWorldThatCounts) {
  const std::vector<LaneChangeRow> good{row(laps::kNominal, kPaper, 2.0, 3.0),
                                        row(laps::kNominal, kOurs, 0.24, 0.59),
                                        row("Putnam car", kOurs, 0.39, 0.9)};
  EXPECT_TRUE(all_held(gates_of(good)));
  for (const auto spoil : {+[](std::vector<LaneChangeRow>& r) { r[1].error.sum_m = 26.0; },
                           +[](std::vector<LaneChangeRow>& r) { r[1].error.max_m = 0.61; },
                           +[](std::vector<LaneChangeRow>& r) { r[1].end = "wall"; },
                           +[](std::vector<LaneChangeRow>& r) { r[1].changes = 0; },
                           +[](std::vector<LaneChangeRow>& r) { r[2].error.sum_m = 41.0; }}) {
    auto bad = good;
    spoil(bad);
    EXPECT_FALSE(all_held(gates_of(bad)));
    bad[1].is_judged = bad[2].is_judged = false;
    EXPECT_TRUE(all_held(gates_of(bad)));
  }
  EXPECT_NE(to_text(good).find("Putnam car"), std::string::npos);
}

}  // namespace
}  // namespace pitwall::control_bench
