// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/radio/age_meter.hpp"

#include <gtest/gtest.h>

namespace pitwall::radio {
namespace {

using telemetry::Group;

TEST(AgeMeter, QuantilesAreOfTheLooks) {
  AgeMeter meter;
  EXPECT_EQ(meter.quantile(Group::kMode, 0.5), Duration{});
  for (int ms = 0; ms < 100; ++ms) meter.look(Group::kMode, milliseconds(ms));
  EXPECT_EQ(meter.quantile(Group::kMode, 0.5), milliseconds(50));
  EXPECT_EQ(meter.quantile(Group::kMode, 0.99), milliseconds(99));
  EXPECT_EQ(meter.worst(Group::kMode), milliseconds(99));
  EXPECT_EQ(meter.looks(Group::kMode), 100u);
  EXPECT_EQ(meter.looks(Group::kEgo), 0u);
}

TEST(AgeMeter, WhatIsOlderThanAllBinsIsInTheLastAndItsWorstIsExact) {
  AgeMeter meter;
  meter.look(Group::kEgo, seconds(60));
  EXPECT_EQ(meter.quantile(Group::kEgo, 0.5), milliseconds(AgeMeter::kBins));
  EXPECT_EQ(meter.worst(Group::kEgo), seconds(60));
}

TEST(AgeMeter, TheWholeStateHasAgesOfItsOwn) {
  AgeMeter meter;
  for (int ms = 0; ms < 100; ++ms) meter.look_at_state(milliseconds(ms));
  EXPECT_EQ(meter.state_quantile(0.5), milliseconds(50));
  EXPECT_EQ(meter.state_quantile(1.0), milliseconds(100));
  EXPECT_EQ(meter.looks(Group::kEgo), 0u);
}

TEST(AgeMeter, ResetForgets) {
  AgeMeter meter;
  meter.look(Group::kEgo, seconds(1));
  meter.look_at_state(seconds(1));
  meter.reset();
  EXPECT_EQ(meter.state_quantile(1.0), Duration{});
  EXPECT_EQ(meter.looks(Group::kEgo), 0u);
  EXPECT_EQ(meter.worst(Group::kEgo), Duration{});
}

}  // namespace
}  // namespace pitwall::radio
