// Ends that begin anew, links that carry one way only or late.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <optional>

#include "tests/system/radio/radio_setups.hpp"

namespace pitwall::radio {
namespace {

using telemetry::Group;
using telemetry::StopLevel;
using telemetry::StopReason;

// Until the base shows a sample that is younger than the restart; none within the limit.
std::optional<Duration> time_to_be_back(VirtualRadio& radio, Duration limit = seconds(3)) {
  const Instant begin = radio.now();
  while (radio.now() - begin < limit) {
    radio.step();
    const auto sample = radio.sample_at_base(Group::kMode);
    if (sample && *sample >= begin) return radio.now() - begin;
  }
  return {};
}

TEST(Restart, TheBaseIsBackWithinOneExchange) {
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U}) {
    RadioSetup setup = setup_of(clean_link());
    setup.seed = seed;
    VirtualRadio radio(setup);
    radio.run(seconds(5) + milliseconds(static_cast<std::int64_t>(seed) * 7));
    radio.restart_base();
    const auto back = time_to_be_back(radio);
    ASSERT_TRUE(back);
    // A packet there that nobody knows, a hint, an opening, an answer, a packet: four ways, air and
    // ticks of the car's loop.
    EXPECT_LE(*back, 5 * kWay + milliseconds(120)) << back->milliseconds();
    EXPECT_EQ(radio.content_errors().all(), 0u);
  }
}

TEST(Restart, TheCarIsBackWithinOneExchange) {
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U}) {
    RadioSetup setup = setup_of(clean_link());
    setup.seed = seed;
    VirtualRadio radio(setup);
    radio.run(seconds(5) + milliseconds(static_cast<std::int64_t>(seed) * 7));
    radio.restart_car();
    const auto back = time_to_be_back(radio);
    ASSERT_TRUE(back);
    EXPECT_LE(*back, 3 * kWay + milliseconds(80)) << back->milliseconds();
    EXPECT_EQ(radio.content_errors().all(), 0u);
  }
}

TEST(Restart, BothAgainAndAgainWhileHalfIsLost) {
  VirtualRadio radio(lossy(0.5, 9));
  for (int i = 0; i < 60; ++i) {
    radio.run(seconds(2));
    (i % 2 == 0) ? radio.restart_base() : radio.restart_car();
    EXPECT_TRUE(time_to_be_back(radio)) << i;
  }
  EXPECT_EQ(radio.content_errors().all(), 0u);
}

TEST(Restart, TheStopStaysLatchedWhateverRestartsAtTheBase) {
  VirtualRadio radio(lossy(0.3, 3));
  radio.run(seconds(2));
  radio.station().stop().demand(StopLevel::kEmergency, StopReason::kOperator);
  radio.run(milliseconds(500));
  ASSERT_EQ(radio.car().view(radio.car_now()).stop, StopLevel::kEmergency);
  for (int i = 0; i < 20; ++i) {
    radio.restart_base();
    radio.run(seconds(1));
    EXPECT_EQ(radio.car().view(radio.car_now()).stop, StopLevel::kEmergency) << i;
  }
  // WHEN the new run of the base says stop again, after a release
  radio.restart_base();
  radio.run(seconds(1));
  radio.car().standstill(true);
  radio.station().authority().take(1, radio.base_now());
  radio.run(milliseconds(300));
  const double challenge = radio.car().view(radio.car_now()).stop_challenge;
  ASSERT_TRUE(radio.station().issue({telemetry::CommandType::kReleaseStop, challenge, 1},
                                    radio.base_now()));
  for (int ms = 0; ms < 1'500; ++ms) {
    radio.step();
    EXPECT_FALSE(radio.car().next_command(radio.car_now()));
  }
  EXPECT_EQ(radio.car().view(radio.car_now()).stop, StopLevel::kNone);
  radio.station().stop().demand(StopLevel::kControlled, StopReason::kOperator);
  radio.run(milliseconds(500));
  EXPECT_EQ(radio.car().view(radio.car_now()).stop, StopLevel::kControlled);
}

TEST(HalfOpen, WhatOnlyGoesDownIsShownAndCommandsHaveNoEffect) {
  VirtualRadio radio(setup_of(clean_link()));
  radio.run(seconds(5));
  const auto alive = radio.car().view(radio.car_now()).alive_at;
  radio.cut(0, false, true);
  radio.run(milliseconds(50));
  radio.reset_ages();
  radio.run(seconds(5));
  EXPECT_LE(radio.ages().worst(Group::kMode), milliseconds(80));
  ASSERT_TRUE(alive && radio.car().view(radio.car_now()).alive_at);
  EXPECT_GE(radio.car_now() - *radio.car().view(radio.car_now()).alive_at, milliseconds(4'900));
}

TEST(HalfOpen, WhatOnlyGoesUpKeepsTheCarInformedAndTheBaseSaysItsStateIsOld) {
  VirtualRadio radio(setup_of(clean_link()));
  radio.run(seconds(5));
  radio.cut(0, true, false);
  radio.run(seconds(5));
  const auto view = radio.car().view(radio.car_now());
  ASSERT_TRUE(view.alive_at);
  EXPECT_LE(radio.car_now() - *view.alive_at, milliseconds(150));
  const Instant shown = radio.station().state().at(Group::kMode);
  EXPECT_GE(radio.base_now() - shown, milliseconds(4'900));
}

// A link that still delivers, half a second late: packets flow, but nothing in them is of now.
TEST(Bufferbloat, WhatFlowsLateIsNotTakenForLive) {
  RadioSetup setup = setup_of(clean_link());
  VirtualRadio radio(setup);
  radio.run(seconds(5));
  RadioSetup late = setup;
  late.up[0].delay = milliseconds(400);
  VirtualRadio bloated(late);
  bloated.run(seconds(5));
  bloated.station().joystick().sample({0.5, 0.2}, bloated.base_now());
  for (int ms = 0; ms < 3'000; ++ms) {
    bloated.station().joystick().sample({0.5, 0.2}, bloated.base_now());
    bloated.step();
    EXPECT_FALSE(bloated.car().view(bloated.car_now()).joystick);
  }
  const auto view = bloated.car().view(bloated.car_now());
  ASSERT_TRUE(view.alive_at);
  EXPECT_GE(bloated.car_now() - *view.alive_at, milliseconds(400));
}

TEST(Clocks, OffsetsOfHoursAndDriftChangeNothing) {
  for (const std::int64_t offset_s : {0, 3'600, -900, 86'400}) {
    RadioSetup setup = setup_of(clean_link());
    setup.clock_offset = seconds(offset_s);
    setup.clock_drift_ppm = 50.0;
    VirtualRadio radio(setup);
    radio.run(seconds(10));
    radio.station().authority().take(1, radio.base_now());
    for (int ms = 0; ms < 2'000; ++ms) {
      radio.station().joystick().sample({0.5, 0.0}, radio.base_now());
      radio.step();
    }
    EXPECT_TRUE(radio.car().view(radio.car_now()).joystick) << offset_s;
    EXPECT_EQ(radio.car().view(radio.car_now()).authority, 1) << offset_s;
    EXPECT_EQ(radio.content_errors().all(), 0u) << offset_s;
  }
}

}  // namespace
}  // namespace pitwall::radio
