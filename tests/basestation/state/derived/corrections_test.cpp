// SPDX-License-Identifier: Apache-2.0
#include "basestation/state/derived/corrections.hpp"

#include <gtest/gtest.h>

namespace pitwall::state {
namespace {

constexpr double kSky = 14.0;

// Two receivers heard twice a second; a stream of corrections, one a second, as each case says.
struct Drive {
  CorrectionMonitor evaluator;
  Instant now{seconds(1'000).ns};
  double age_s[2] = {0.5, 0.5};
  bool ever = false;

  void run(double length_s, bool flows_0, bool flows_1, double satellites = kSky) {
    constexpr double kStep_s = 0.5;
    for (double t = 0.0; t < length_s; t += kStep_s) {
      now += from_seconds(kStep_s);
      const bool flows[2] = {flows_0, flows_1};
      for (std::size_t unit = 0; unit < 2; ++unit) {
        age_s[unit] = flows[unit] ? 0.5 : age_s[unit] + kStep_s;
        evaluator.receive(unit, age_s[unit], satellites, now);
      }
      ever = ever || evaluator.conflict(now);
    }
  }
};

TEST(Corrections, TwoUsersOfOneLoginAreSeen) {
  Drive drive;
  drive.run(30, true, true);
  for (int i = 0; i < 4; ++i) {
    drive.run(7, false, false);
    drive.run(6, true, true);
  }
  drive.run(7, false, false);
  EXPECT_TRUE(drive.evaluator.conflict(drive.now));
  drive.run(70, true, true);
  EXPECT_FALSE(drive.evaluator.conflict(drive.now));  // and is over when they have agreed
}

TEST(Corrections, ATunnelIsNone) {
  Drive drive;
  drive.run(30, true, true);
  for (int i = 0; i < 10; ++i) {  // both receivers, again and again, but without a sky
    drive.run(7, false, false, 2.0);
    drive.run(8, true, true);
  }
  EXPECT_FALSE(drive.ever);
}

// The sky comes back before the corrections do.
TEST(Corrections, NorIsTheEndOfATunnel) {
  Drive drive;
  drive.run(30, true, true);
  for (int i = 0; i < 10; ++i) {
    drive.run(3, false, false, 2.0);
    drive.run(4, false, false);
    drive.run(8, true, true);
  }
  EXPECT_FALSE(drive.ever);
}

TEST(Corrections, OneReceiverAloneIsNone) {
  Drive drive;
  drive.run(30, true, true);
  for (int i = 0; i < 8; ++i) {
    drive.run(7, false, true);
    drive.run(6, true, true);
  }
  EXPECT_FALSE(drive.ever);
}

TEST(Corrections, LongStreamsThatEndAreNone) {
  Drive drive;
  for (int i = 0; i < 6; ++i) {
    drive.run(25, true, true);
    drive.run(7, false, false);
  }
  EXPECT_FALSE(drive.ever);
}

TEST(Corrections, TwoLossesAreNotEnough) {
  Drive drive;
  drive.run(30, true, true);
  drive.run(7, false, false);
  for (int i = 0; i < 2; ++i) {
    drive.run(6, true, true);
    drive.run(7, false, false);
  }
  drive.run(60, true, true);
  EXPECT_FALSE(drive.ever);
}

TEST(Corrections, NoNumbersAreNone) {
  CorrectionMonitor evaluator;
  for (int i = 0; i < 200; ++i) {
    const Instant at = Instant{} + seconds(i);
    evaluator.receive(0, kUnset, kUnset, at);
    evaluator.receive(1, kUnset, kSky, at);
    EXPECT_FALSE(evaluator.conflict(at));
  }
}

}  // namespace
}  // namespace pitwall::state
