// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/radio/virtual_radio.hpp"

#include <gtest/gtest.h>

namespace pitwall::radio {
namespace {

using telemetry::Group;

RadioSetup clean(Duration delay) {
  RadioSetup setup;
  for (auto* link : {&setup.down[0], &setup.up[0]}) {
    link->rate_bytes_per_s = 32'000;
    link->delay = delay;
  }
  return setup;
}

TEST(VirtualRadio, ACleanLinkShowsWhatTheCarHasAndHowOldItIs) {
  VirtualRadio radio(clean(milliseconds(15)));
  radio.run(seconds(10));
  EXPECT_GT(radio.arrivals(), 480u);
  EXPECT_TRUE(radio.station().clock_known());
  EXPECT_EQ(radio.content_errors().too_young, 0u);
  EXPECT_EQ(radio.content_errors().never_sampled, 0u);
  EXPECT_EQ(radio.content_errors().went_back, 0u);
  EXPECT_LE(radio.ages().quantile(Group::kMode, 0.99), milliseconds(50));
  EXPECT_LE(radio.ages().quantile(Group::kEgo, 0.99), milliseconds(50));
}

// All of the vehicle state at once is as old as its oldest group: never younger than any of them.
TEST(VirtualRadio, TheWholeStateIsAsOldAsItsOldestGroup) {
  VirtualRadio radio(clean(milliseconds(15)));
  radio.run(seconds(5));
  radio.reset_ages();
  radio.run(seconds(10));
  for (const Group group : {Group::kEgo, Group::kTyres, Group::kTread, Group::kBrakes}) {
    EXPECT_GE(radio.ages().state_quantile(0.5), radio.ages().quantile(group, 0.5));
    EXPECT_GE(radio.ages().state_quantile(1.0), radio.ages().quantile(group, 1.0));
  }
  EXPECT_LE(radio.ages().state_quantile(1.0), milliseconds(200));
}

TEST(VirtualRadio, OneSeedIsOneRun) {
  RadioSetup setup = clean(milliseconds(15));
  setup.down[0].loss = setup.up[0].loss = 0.3;
  setup.seed = 7;
  VirtualRadio one(setup), again(setup);
  setup.seed = 8;
  VirtualRadio other(setup);
  for (auto* radio : {&one, &again, &other}) radio->run(seconds(20));
  EXPECT_EQ(one.arrivals(), again.arrivals());
  EXPECT_NE(one.arrivals(), other.arrivals());
}

TEST(VirtualRadio, ClocksThatDifferAndDriftMakeNothingYoungerThanItIs) {
  RadioSetup setup = clean(milliseconds(15));
  setup.clock_offset = seconds(-777);
  setup.clock_drift_ppm = 50.0;
  setup.down[0].jitter = setup.up[0].jitter = milliseconds(20);
  setup.down[0].loss = setup.up[0].loss = 0.3;
  VirtualRadio radio(setup);
  radio.run(seconds(120));
  EXPECT_GT(radio.arrivals(), 3'000u);
  EXPECT_EQ(radio.content_errors().too_young, 0u);
}

TEST(VirtualRadio, AnOnlookerWouldNoticeAnEndThatToldLies) {
  // GIVEN a base whose clock jumps, which no clock of this car does: the one way to a wrong age
  RadioSetup setup = clean(milliseconds(15));
  setup.clock_drift_ppm = -20'000.0;
  VirtualRadio radio(setup);
  radio.run(seconds(60));
  EXPECT_GT(radio.content_errors().too_young, 0u);
}

}  // namespace
}  // namespace pitwall::radio
