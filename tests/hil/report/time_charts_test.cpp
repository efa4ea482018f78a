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

// A run that a contact cut off has no frames afterwards; that is no empty bus.
TEST(TimeCharts, TheBusLoadEndsWithTheRun) {
  RunData run = run_of({});
  run.facts.duration_s = 4.0 * run.truth.back().t_s;
  const std::string html = time_charts(run);
  const auto last_x = [&](const std::string& plot) {
    const std::size_t line = html.find("<path class=\"mark\"", html.find("\"" + plot + "\""));
    const std::string path = html.substr(line, html.find("/>", line) - line);
    return std::stod(path.substr(path.rfind('L') + 1));
  };
  // The last window of 0.25 s is drawn at its middle, and pixels have one decimal.
  constexpr double kWidth_px = 1060.0;
  const double half_window_px = 0.5 * 0.25 * kWidth_px / run.end_s();
  EXPECT_NEAR(last_x("bus_load"), last_x("wall_gap"), half_window_px + 0.1);
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
