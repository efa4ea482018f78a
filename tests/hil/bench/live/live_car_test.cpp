// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/live/live_car.hpp"

#include <gtest/gtest.h>

#include "tests/hil/bench/live/trap.hpp"

namespace pitwall::bench {
namespace {

TEST(LiveCar, WhatTheBenchDoesNotKnowIsRefusedBeforeTheBusIsOpened) {
  Trap trap;
  const LivePlan plan = trap.plan();
  scenario::Scenario wrong = lap().scenario;
  wrong.expect[0].condition.signal = "speed_of_light";
  const auto signal = LiveCar::open(wrong, lap().setup, plan, false);
  ASSERT_FALSE(signal);
  EXPECT_NE(to_string(signal.error()).find("speed_of_light"), std::string::npos);

  wrong = lap().scenario;
  wrong.faults.push_back({.kind = "earthquake", .place = "x.yaml:3:1"});
  const auto fault = LiveCar::open(wrong, lap().setup, plan, false);
  ASSERT_FALSE(fault);
  EXPECT_EQ(fault.error().place, "x.yaml:3:1");

  wrong = lap().scenario;
  wrong.receivers.emplace();
  const auto receivers = LiveCar::open(wrong, lap().setup, plan, false);
  ASSERT_FALSE(receivers);
  EXPECT_EQ(receivers.error().place, "receivers");
  EXPECT_TRUE(trap.untouched());
}

}  // namespace
}  // namespace pitwall::bench
