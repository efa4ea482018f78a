// SPDX-License-Identifier: Apache-2.0
#include "hil/grading/reaction.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace pitwall::grading {
namespace {

constexpr int kGreen = 0, kYellow = 3, kRed = 6;
constexpr Duration kTick = milliseconds(10);

// A car that lifts so long after it is told, then brakes at 10 m/s2.
struct Drive {
  ReactionMonitor monitor;
  ReactionTick tick{.restriction = kGreen,
                    .flag = "green",
                    .stop = {},
                    .speed_mps = 50.0,
                    .throttle = 0.8,
                    .brake_kpa = 0.0};

  void go(Duration span, double accel_mps2 = 0.0) {
    for (Duration done{}; done < span; done = done + kTick) {
      tick.at += kTick;
      tick.speed_mps = std::max(0.0, tick.speed_mps + accel_mps2 * kTick.seconds());
      monitor.observe(tick);
    }
  }
  void flag(int restriction, std::string_view name) {
    tick.restriction = restriction;
    tick.flag = name;
  }
  void lift() { tick.throttle = 0.0; }
  const Reaction& newest() const { return monitor.reactions().back(); }
};

TEST(Reaction, OfARedFlagIsUntilTheCarLiftsAndUntilItStands) {
  Drive drive;
  drive.go(seconds(1));
  drive.flag(kRed, "red");
  drive.go(milliseconds(200));
  ASSERT_EQ(drive.monitor.reactions().size(), 1U);
  EXPECT_FALSE(drive.newest().reaction);
  drive.lift();
  drive.go(seconds(6), -10.0);
  EXPECT_EQ(drive.newest().to, "red");
  EXPECT_EQ(drive.newest().speed_mps, 50.0);
  EXPECT_EQ(drive.newest().reaction, milliseconds(200));
  // 0.2 s at 50 m/s, and v2 / 2a = 125 m.
  EXPECT_NEAR(drive.newest().stop_m.value(), 135.0, 0.5);
}

TEST(Reaction, BrakeOrAStopOfTheCarAreAnswersToo) {
  Drive brakes;
  brakes.tick.throttle = 0.0;  // there is nothing to lift
  brakes.go(seconds(1));
  brakes.flag(kYellow, "yellow");
  brakes.go(milliseconds(50));
  brakes.tick.brake_kpa = 400.0;
  brakes.go(kTick);
  EXPECT_EQ(brakes.newest().reaction, milliseconds(50));
  Drive stops;
  stops.go(seconds(1));
  stops.flag(kRed, "red");
  stops.go(milliseconds(30));
  stops.tick.stop = "controlled stop";
  stops.go(seconds(1));
  ASSERT_EQ(stops.monitor.reactions().size(), 1U);  // the stop answers the flag
  EXPECT_EQ(stops.newest().reaction, milliseconds(30));
}

TEST(Reaction, AStopWithoutAFlagIsCounted) {
  Drive drive;
  drive.go(seconds(1));
  drive.tick.stop = "emergency stop";
  drive.go(seconds(6), -10.0);
  ASSERT_EQ(drive.monitor.reactions().size(), 1U);
  EXPECT_EQ(drive.newest().to, "emergency stop");
  EXPECT_EQ(drive.newest().reaction, Duration{});
  EXPECT_NEAR(drive.newest().stop_m.value(), 125.0, 1.0);
}

TEST(Reaction, NeitherAReleaseNorAFlagForAStandingCarIsOne) {
  Drive drive;
  drive.flag(kRed, "red");
  drive.go(seconds(1));
  drive.flag(kGreen, "green");
  drive.go(seconds(1));
  EXPECT_TRUE(drive.monitor.reactions().empty());
  drive.tick.speed_mps = 0.0;
  drive.go(seconds(1));
  drive.flag(kRed, "red");
  drive.go(seconds(1));
  EXPECT_TRUE(drive.monitor.reactions().empty());
}

TEST(Reaction, GreenAgainBeforeTheCarStoodEndsTheCount) {
  Drive drive;
  drive.go(seconds(1));
  drive.flag(kYellow, "yellow");
  drive.lift();
  drive.go(seconds(2), -5.0);
  drive.flag(kGreen, "green");
  drive.go(seconds(20), -5.0);
  EXPECT_TRUE(drive.newest().reaction);
  EXPECT_FALSE(drive.newest().stop_m);
}

TEST(Reaction, ManyAreCountedAndTheFirstKept) {
  Drive drive;
  for (std::size_t i = 0; i < ReactionMonitor::kKept + 5; ++i) {
    drive.flag(kGreen, "green");
    drive.go(milliseconds(20));
    drive.flag(kYellow, "yellow");
    drive.go(milliseconds(20));
  }
  EXPECT_EQ(drive.monitor.reactions().size(), ReactionMonitor::kKept);
  EXPECT_EQ(drive.monitor.left_out(), 5U);
}

}  // namespace
}  // namespace pitwall::grading
