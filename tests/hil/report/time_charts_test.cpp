// SPDX-License-Identifier: Apache-2.0
#include "hil/report/time_charts.hpp"

#include <gtest/gtest.h>

#include "tests/hil/report/some_run.hpp"

namespace pitwall::report {
namespace {

TEST(TimeCharts, AWholeRunLeavesNothingOut) {
  const std::string html = time_charts(run_of({}));
  for (const char* name :
       {"states", "speed", "cross_track", "wall_gap", "pedals", "steering", "bus_load", "tyres"})
    EXPECT_EQ(count(html, "data-plot=\"" + std::string(name) + "\""), 1u) << name;
  EXPECT_EQ(count(html, "class=\"absent\""), 0u);
  EXPECT_EQ(count(html, "data-name=\"target\""), 1u);
  EXPECT_GE(count(html, "unvalidated"), 1u) << "the tyre model is not";
}

TEST(TimeCharts, AFaultShadesEveryPlotWhileItLasts) {
  const std::string html = time_charts(run_of({}));
  EXPECT_EQ(count(html, "fill-opacity=\"0.16\"><title>steering_stuck"), 7u);
  EXPECT_EQ(count(html, "data-label=\"steering_stuck\""), 1u) << "and has a lane";
}

TEST(TimeCharts, AViolationHasItsPlace) {
  EXPECT_EQ(count(time_charts(run_of({.with_failure = true})), "data-label=\"first violation"), 1u);
}

TEST(TimeCharts, WhatALiveRunDoesNotKnowIsSaid) {
  const std::string html = time_charts(run_of({.mode = "live", .with_car = false}));
  EXPECT_EQ(count(html, "data-absent=\"target_speed\""), 1u);
  EXPECT_EQ(count(html, "data-name=\"target\""), 0u);
  EXPECT_EQ(count(html, "data-name=\"car mode\""), 0u);
  EXPECT_GE(count(html, "process of its own"), 2u);
}

TEST(TimeCharts, WithoutATruthEveryPlotSaysSo) {
  const std::string html = time_charts(RunData{});
  EXPECT_EQ(count(html, "data-plot=\"speed\""), 0u);
  EXPECT_GE(count(html, "class=\"absent\""), 7u);
}

}  // namespace
}  // namespace pitwall::report
