// SPDX-License-Identifier: Apache-2.0
#include "protocol/rules/fuel_use.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace pitwall::rules {
namespace {

constexpr Instant kFirst{seconds(100).ns};
constexpr EngineSample kHard{.speed_rpm = 6'000, .throttle = 0.7, .running = true};

// The same quarter of an hour, told at different rates.
double used_l(Duration every) {
  FuelUse use;
  for (Duration at{}; at <= seconds(900); at = at + every) {
    EngineSample sample = kHard;
    sample.throttle = 0.5 + 0.2 * std::sin(at.seconds() / 30.0);
    use.receive(sample, kFirst + at);
  }
  return use.used_l();
}

TEST(FuelUse, TheRateOfTheSamplesDoesNotMatter) {
  EXPECT_NEAR(used_l(milliseconds(20)), used_l(seconds(1)), 0.01 * used_l(seconds(1)));
}

// What nobody heard may have been driven at either end's flow: the greater is taken.
TEST(FuelUse, ALongGapIsBridgedOnTheThirstySide) {
  EngineSample idle = kHard;
  idle.throttle = 0.0;
  FuelUse use;
  use.receive(idle, kFirst);
  use.receive(kHard, kFirst + seconds(10));
  EXPECT_NEAR(use.used_l(), 10.0 * fuel_flow_lps(kHard), 1e-9);
}

TEST(FuelUse, SamplesOutOfOrderOrWithoutNumbersAreNone) {
  FuelUse use;
  use.receive(kHard, kFirst);
  use.receive(kHard, kFirst + seconds(1));
  const double used_l = use.used_l();
  use.receive(kHard, kFirst);
  use.receive({.speed_rpm = kUnset, .throttle = 1.0, .running = true}, kFirst + seconds(2));
  EXPECT_EQ(use.used_l(), used_l);
}

TEST(FuelUse, AnEngineThatStandsBurnsNothingOneThatIdlesALittle) {
  EXPECT_EQ(fuel_flow_lps({.speed_rpm = 1'500, .throttle = 0.0, .running = false}), 0.0);
  EXPECT_NEAR(fuel_flow_lps({.speed_rpm = 1'500, .throttle = 0.0, .running = true}) * 3'600.0,
              FuelUse::kIdle_lph, 1e-9);
}

// No throttle is called cheaper than less of it, at any speed.
TEST(FuelUse, MoreThrottleNeverBurnsLess) {
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
}  // namespace pitwall::rules
