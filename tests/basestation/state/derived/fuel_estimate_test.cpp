// SPDX-License-Identifier: Apache-2.0
#include "basestation/state/derived/fuel_estimate.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace pitwall::state {
namespace {

constexpr Instant kBegin{seconds(100).ns};
constexpr EngineSample kFast{.speed_rpm = 6'000, .throttle = 0.7, .running = true};

// The same quarter of an hour, told at different rates.
double used_l(Duration every) {
  FuelEstimate estimate;
  for (Duration at{}; at <= seconds(900); at = at + every) {
    EngineSample sample = kFast;
    sample.throttle = 0.5 + 0.2 * std::sin(at.seconds() / 30.0);
    estimate.receive(sample, kBegin + at);
  }
  return estimate.used_l();
}

TEST(FuelEstimate, NobodyHasLoadedMeansNobodyKnows) {
  FuelEstimate estimate;
  estimate.receive(kFast, kBegin);
  estimate.receive(kFast, kBegin + seconds(1));
  EXPECT_TRUE(std::isnan(estimate.level_l()));
  EXPECT_GT(estimate.used_l(), 0.0);
}

TEST(FuelEstimate, WhatIsUsedLeavesTheTankAndNoMore) {
  FuelEstimate estimate;
  estimate.receive(kFast, kBegin);
  estimate.receive(kFast, kBegin + seconds(1));
  estimate.loaded(20.0);
  EXPECT_EQ(estimate.level_l(), 20.0) << "what was burnt before was not in it";
  const double before_l = estimate.used_l();
  estimate.receive(kFast, kBegin + seconds(2));
  EXPECT_NEAR(estimate.level_l(), 20.0 - (estimate.used_l() - before_l), 1e-12);
  EXPECT_NEAR(estimate.used_l() - before_l, fuel_flow_lps(kFast), 1e-12);
  estimate.receive(kFast, kBegin + seconds(4'000));
  EXPECT_EQ(estimate.level_l(), 0.0);
  estimate.loaded(30.0);
  EXPECT_EQ(estimate.level_l(), 30.0);
  estimate.loaded(kUnset);
  EXPECT_EQ(estimate.level_l(), 30.0);
}

TEST(FuelEstimate, TheRateOfTheSamplesDoesNotMatter) {
  EXPECT_NEAR(used_l(milliseconds(20)), used_l(seconds(1)), 0.01 * used_l(seconds(1)));
}

// What nobody heard may have been driven at either end's flow: the greater is taken.
TEST(FuelEstimate, ALongGapIsBridgedOnTheThirstySide) {
  EngineSample idle = kFast;
  idle.throttle = 0.0;
  FuelEstimate estimate;
  estimate.receive(idle, kBegin);
  estimate.receive(kFast, kBegin + seconds(10));
  EXPECT_NEAR(estimate.used_l(), 10.0 * fuel_flow_lps(kFast), 1e-9);
}

TEST(FuelEstimate, SamplesOutOfOrderOrWithoutNumbersAreNone) {
  FuelEstimate estimate;
  estimate.receive(kFast, kBegin);
  estimate.receive(kFast, kBegin + seconds(1));
  const double used_l = estimate.used_l();
  estimate.receive(kFast, kBegin);
  estimate.receive({.speed_rpm = kUnset, .throttle = 1.0, .running = true}, kBegin + seconds(2));
  EXPECT_EQ(estimate.used_l(), used_l);
}

TEST(FuelEstimate, AnEngineThatStandsBurnsNothingOneThatIdlesALittle) {
  EXPECT_EQ(fuel_flow_lps({.speed_rpm = 1'500, .throttle = 0.0, .running = false}), 0.0);
  EXPECT_NEAR(fuel_flow_lps({.speed_rpm = 1'500, .throttle = 0.0, .running = true}) * 3'600.0,
              FuelEstimate::kIdle_lph, 1e-9);
}

// No throttle is called cheaper than less of it, at any speed.
TEST(FuelEstimate, MoreThrottleNeverBurnsLess) {
  for (double rpm = 1'000; rpm <= 7'200; rpm += 50) {
    double least = 0.0;
    for (double throttle = 0.0; throttle <= 1.0; throttle += 0.02) {
      const double flow = fuel_flow_lps({rpm, throttle, true});
      EXPECT_GE(flow, least);
      least = flow;
    }
  }
}

}  // namespace
}  // namespace pitwall::state
