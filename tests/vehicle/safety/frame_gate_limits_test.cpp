// SPDX-License-Identifier: Apache-2.0
// What one frame may say: ranges, tables, slews, in every mode.
#include "vehicle/safety/frame_gate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "tests/vehicle/safety/frame_gate_bench.hpp"
#include "tests/vehicle/safety/situation.hpp"

namespace pitwall::safety {
namespace {

namespace av21 = can::av21;
using namespace testing;
using world::Mode;

// Stated here a second time: a limit moves only where two places say so.
TEST(FrameGateLimits, WhatTheyAreUnlessACarFileSaysOtherwise) {
  constexpr std::array<SteerRow, 10> kSteer{{{0, 240},
                                             {15, 240},
                                             {20, 230},
                                             {25, 200},
                                             {30, 165},
                                             {40, 97},
                                             {50, 66},
                                             {60, 50},
                                             {70, 40},
                                             {80, 33}}};
  const GateParams p;
  ASSERT_EQ(p.steer.size(), kSteer.size());
  for (std::size_t i = 0; i < kSteer.size(); ++i) {
    EXPECT_EQ(p.steer[i].speed_mps, kSteer[i].speed_mps);
    EXPECT_EQ(p.steer[i].motor_deg, kSteer[i].motor_deg);
  }
  EXPECT_EQ(p.steer_slew_deg_per_s, 720.0);
  EXPECT_EQ(p.brake_max_kpa, 6000.0);
  EXPECT_EQ(p.brake_rise_kpa_per_s, 30000.0);
  EXPECT_EQ(p.brake_fall_kpa_per_s, 60000.0);
  EXPECT_EQ(p.throttle_max_percent, 100.0);
  EXPECT_EQ(p.throttle_rise_percent_per_s, 400.0);
  EXPECT_EQ(p.both_throttle_percent, 2.0);
  EXPECT_EQ(p.both_brake_kpa, 100.0);
  EXPECT_EQ(p.standing_mps, 1.0);
  EXPECT_EQ(p.gear_max, 6);
  EXPECT_EQ(p.shift_least, milliseconds(100));
  EXPECT_EQ(p.command_age_max, milliseconds(50));
}

// Any table that a car file may hold: every segment counts, the flat ones of the default too.
TEST(FrameGateLimits, SteeringLimitOfAnyTable) {
  Random random{5};
  for (int table = 0; table < 200; ++table) {
    GateParams p;
    double speed_mps = 0.0, deg = 300.0;
    for (SteerRow& row : p.steer) {
      row = {speed_mps, deg};
      speed_mps += random.between(0.5, 11.0);
      deg -= random.between(0.0, 29.0);
    }
    for (std::size_t i = 0; i < kSteerRows; ++i)
      ASSERT_NEAR(steer_limit_deg(p, p.steer[i].speed_mps), p.steer[i].motor_deg, 1e-9);
    for (std::size_t i = 1; i < kSteerRows; ++i) {
      const SteerRow &a = p.steer[i - 1], &b = p.steer[i];
      const double share = random.between(0.0, 1.0);
      ASSERT_NEAR(steer_limit_deg(p, std::lerp(a.speed_mps, b.speed_mps, share)),
                  std::lerp(a.motor_deg, b.motor_deg, share), 1e-9);
    }
  }
}

TEST(FrameGateLimits, SteeringLimitOfTheTableAtEverySpeed) {
  const GateParams p;
  for (double v = 0.0; v <= 90.0; v += 2.5) {
    double limit = p.steer.back().motor_deg;
    for (std::size_t i = 1; i < kSteerRows; ++i) {
      const SteerRow &a = p.steer[i - 1], &b = p.steer[i];
      if (v < a.speed_mps || v > b.speed_mps) continue;
      limit = std::lerp(a.motor_deg, b.motor_deg, (v - a.speed_mps) / (b.speed_mps - a.speed_mps));
    }
    ASSERT_NEAR(steer_limit_deg(p, v), limit, 1e-9);
    for (double deg = -300.0; deg <= 300.0;
         deg += std::abs(std::abs(deg) - limit) < 4 ? 0.5 : 7.5) {
      Gate g;
      g.context.speed_mps = v;
      EXPECT_EQ(g.one(steer(deg)), std::abs(deg) <= limit ? Verdict::kPass : Verdict::kOutOfRange)
          << v << ' ' << deg;
    }
  }
  EXPECT_EQ(steer_limit_deg(p, -5.0), p.steer.front().motor_deg);
  EXPECT_EQ(steer_limit_deg(p, 500.0), p.steer.back().motor_deg);
  EXPECT_EQ(steer_limit_deg(p, kUnset), p.steer.back().motor_deg) << "unknown is the fastest";
  for (std::size_t i = 1; i < kSteerRows; ++i) {
    EXPECT_GT(p.steer[i].speed_mps, p.steer[i - 1].speed_mps);
    EXPECT_LE(p.steer[i].motor_deg, p.steer[i - 1].motor_deg);
  }
}

// All that the field can hold, written by hand: two's complement in 11 bits of half a degree. The
// traps are -512 and 511.5, whose signs one bit decides, and 0x3FE, which is -1 in ten bits.
TEST(FrameGateLimits, EveryAngleThatTheFieldCanHold) {
  for (int raw = 0; raw < 2048; ++raw) {
    const double deg = 0.5 * (raw < 1024 ? raw : raw - 2048);
    for (const auto& [speed_mps, limit_deg] : {SteerRow{0, 240}, {30, 165}, {80, 33}}) {
      Gate g;
      g.context.speed_mps = speed_mps;
      can::Frame frame = blank(1402, 8);
      frame.data[0] = static_cast<std::uint8_t>(raw & 0xFF);
      frame.data[1] = static_cast<std::uint8_t>(raw >> 8);
      const bool in = -limit_deg <= deg && deg <= limit_deg;
      EXPECT_EQ(g.one(frame), in ? Verdict::kPass : Verdict::kOutOfRange) << raw << ' ' << deg;
    }
  }
}

TEST(FrameGateLimits, SteeringSlewInRealTimeBothWays) {
  for (const std::int64_t ms : {1, 5, 10, 20, 37, 100}) {
    const double allowed = 720.0 * 0.001 * static_cast<double>(ms) + 0.5;
    for (double change = -120.0; change <= 120.0;
         change += std::abs(std::abs(change) - allowed) < 3 ? 0.5 : 4.5) {
      Gate g;
      g.context.speed_mps = 10.0;
      ASSERT_EQ(g.one(steer(10.0, 0)), Verdict::kPass);
      g.wait(milliseconds(ms));
      EXPECT_EQ(g.one(steer(10.0 + change, 1)),
                std::abs(change) <= allowed ? Verdict::kPass : Verdict::kTooFast)
          << ms << ' ' << change;
    }
  }
}

TEST(FrameGateLimits, BrakeRangeAndSlewWithASlowerRiseThanFall) {
  for (double kpa = 0; kpa <= 8191; kpa += std::abs(kpa - 6000) < 6 ? 1 : 173) {
    Gate g;
    EXPECT_EQ(g.one(brake(kpa)), kpa <= 6000 ? Verdict::kPass : Verdict::kOutOfRange) << kpa;
  }
  for (int change = -1500; change <= 1500; ++change) {
    if (std::abs(std::abs(change) - 301) > 5 && std::abs(std::abs(change) - 601) > 5 &&
        change % 97 != 0)
      continue;
    Gate g;
    ASSERT_EQ(g.one(brake(3000, 0)), Verdict::kPass);
    g.wait(milliseconds(10));
    const bool passes = change <= 301 && change >= -601;
    EXPECT_EQ(g.one(brake(3000 + change, 1)), passes ? Verdict::kPass : Verdict::kTooFast)
        << change;
  }
}

TEST(FrameGateLimits, EveryLimitItselfPassesAndTheNextStepDoesNot) {
  EXPECT_EQ(Gate{}.one(brake(6000)), Verdict::kPass);
  EXPECT_EQ(Gate{}.one(brake(6001)), Verdict::kOutOfRange);
  EXPECT_EQ(Gate{}.one(throttle(100.0)), Verdict::kPass);
  EXPECT_EQ(Gate{}.one(throttle(100.01)), Verdict::kOutOfRange);
  EXPECT_EQ(Gate{}.one(throttle(0.0)), Verdict::kPass);
  EXPECT_EQ(Gate{}.one(throttle(-0.01)), Verdict::kOutOfRange);
}

TEST(FrameGateLimits, ThrottleRangeAndSlewWhereLiftingIsFree) {
  for (double percent = -100; percent <= 327; percent += 0.37) {
    Gate g;
    const can::Frame frame = throttle(percent);
    av21::AcceleratorCmd sent;
    ASSERT_TRUE(av21::decode(frame, sent));
    const bool in = sent.acc_pedal_cmd >= 0.0 && sent.acc_pedal_cmd <= 100.0;
    EXPECT_EQ(g.one(frame), in ? Verdict::kPass : Verdict::kOutOfRange) << percent;
  }
  for (int change = -5000; change <= 4900; change += 25) {  // hundredths
    Gate g;
    ASSERT_EQ(g.one(throttle(50, 0)), Verdict::kPass);
    g.wait(milliseconds(10));
    EXPECT_EQ(g.one(throttle(50 + change / 100.0, 1)),
              change <= 400 ? Verdict::kPass : Verdict::kTooFast)
        << change;
  }
}

// Between two ticks, where rounding alone makes the next hundredth: 4.002 % and the step.
TEST(FrameGateLimits, RoundingMayAddOneStepToAThrottleSlew) {
  for (int change = 390; change < 410; ++change) {
    Gate g;
    ASSERT_EQ(g.one(throttle(50, 0)), Verdict::kPass);
    g.wait(microseconds(10005));
    EXPECT_EQ(g.one(throttle(50 + change / 100.0, 1)),
              change <= 401 ? Verdict::kPass : Verdict::kTooFast)
        << change;
  }
}

TEST(FrameGateLimits, ThrottleNeedsAModeThatDrivesAndNeverRisesInAStop) {
  for (const Mode mode : kAllModes) {
    if (mode == Mode::kDisarmed) continue;
    const bool stops = mode == Mode::kControlledStop || mode == Mode::kEmergencyStop;
    for (const double before : {0.0, 10.0, 40.0}) {
      for (const double percent : {0.0, 0.01, 9.99, 10.0, 10.01, 30.0}) {
        Gate g;
        ASSERT_EQ(g.one(throttle(before, 0)), Verdict::kPass);
        g.wait(seconds(1));
        g.context.mode = mode;
        Verdict expected = Verdict::kPass;
        if (mode != Mode::kDriving && percent > 0.0)
          expected = !stops             ? Verdict::kThrottleForbidden
                     : percent > before ? Verdict::kThrottleRises
                                        : Verdict::kPass;
        EXPECT_EQ(g.one(throttle(percent, 1)), expected) << static_cast<int>(mode) << percent;
      }
    }
    Gate fresh;
    fresh.context.mode = mode;
    const Verdict first = fresh.one(throttle(5));
    EXPECT_EQ(first == Verdict::kPass, mode == Mode::kDriving) << "no memory is no permission";
  }
}

TEST(FrameGateLimits, GearsOneStepAtATimeAndNeutralOnlyStanding) {
  for (int number = 0; number < 256; ++number) {
    for (const double v : {0.0, 0.99, 1.0, 30.0, kUnset}) {
      Gate g;
      g.context.speed_mps = v;
      const bool in = (number >= 1 && number <= 6) || (number == 0 && v < 1.0);
      EXPECT_EQ(g.one(gear(number)), in ? Verdict::kPass : Verdict::kOutOfRange) << number << v;
    }
  }
  for (int from = 1; from <= 6; ++from) {
    for (int to = 1; to <= 6; ++to) {
      for (const std::int64_t ms : {99, 100}) {
        Gate g;
        ASSERT_EQ(g.one(gear(from)), Verdict::kPass);
        g.wait(milliseconds(50));
        ASSERT_EQ(g.one(gear(from)), Verdict::kPass) << "holding is no shift";
        g.wait(milliseconds(ms - 50));
        const bool passes = to == from || (std::abs(to - from) == 1 && ms >= 100);
        EXPECT_EQ(g.one(gear(to)), passes ? Verdict::kPass : Verdict::kGearStep)
            << from << to << ms;
      }
    }
  }
}

TEST(FrameGateLimits, ThrottleYieldsToBrakeWhicheverComesFirst) {
  for (const double percent : {0.0, 1.99, 2.0, 2.01, 50.0}) {
    for (const double kpa : {0.0, 99.0, 100.0, 101.0, 2000.0}) {
      for (const bool brake_first : {true, false}) {
        Gate g;
        const std::vector<can::Frame> frames = brake_first
                                                   ? std::vector{brake(kpa), throttle(percent)}
                                                   : std::vector{throttle(percent), brake(kpa)};
        const GateOutput out = g.all(frames);
        const bool contradiction = percent > 2.0 && kpa > 100.0;
        ASSERT_EQ(out.verdicts.size(), 2u);
        EXPECT_EQ(out.verdicts[brake_first ? 0 : 1].verdict, Verdict::kPass);
        EXPECT_EQ(out.verdicts[brake_first ? 1 : 0].verdict,
                  contradiction ? Verdict::kThrottleWithBrake : Verdict::kPass);
        EXPECT_EQ(out.refused_now, contradiction);
      }
    }
  }
}

TEST(FrameGateLimits, TheBrakeThatCountsIsTheLastThatPassed) {
  Gate g;
  ASSERT_EQ(g.one(brake(101, 0)), Verdict::kPass);
  g.wait(seconds(5));
  EXPECT_EQ(g.one(throttle(2.01, 0)), Verdict::kThrottleWithBrake) << "however long ago";
  EXPECT_EQ(g.one(brake(6001, 1)), Verdict::kOutOfRange);
  EXPECT_EQ(g.one(throttle(2.0, 0)), Verdict::kPass);
  EXPECT_EQ(g.one(brake(100, 1)), Verdict::kPass);
  EXPECT_EQ(g.one(brake(6001, 2)), Verdict::kOutOfRange);
  g.wait(milliseconds(10));
  EXPECT_EQ(g.one(throttle(2.01, 1)), Verdict::kPass) << "a refused brake does not brake";
}

TEST(FrameGateLimits, ShiftsAreCountedFromTheLastShift) {
  Gate g;
  ASSERT_EQ(g.one(gear(3)), Verdict::kPass);
  g.wait(seconds(1));
  ASSERT_EQ(g.one(gear(4)), Verdict::kPass);
  for (int ms = 1; ms < 100; ++ms) {
    g.wait(milliseconds(1));
    if (ms % 9 == 0) {
      EXPECT_EQ(g.one(gear(4)), Verdict::kPass);
    } else if (ms % 9 == 1) {
      EXPECT_EQ(g.one(gear(3)), Verdict::kGearStep) << ms;
      EXPECT_EQ(g.one(gear(5)), Verdict::kGearStep) << ms;
    }
  }
  g.wait(milliseconds(1));
  EXPECT_EQ(g.one(gear(5)), Verdict::kPass);
}

TEST(FrameGateLimits, OnlyListedCtStates) {
  for (int ct = 0; ct < 1000; ++ct) {
    Gate g;
    g.context.speed_mps = 0.0;
    const bool listed = (ct >= 1 && ct <= 12) || ct == 255;
    EXPECT_EQ(g.one(report(ct)), listed ? Verdict::kPass : Verdict::kOutOfRange) << ct;
  }
}

TEST(FrameGateLimits, OnlyListedTractionSwitches) {
  for (int aim = 0; aim < 16; ++aim) {
    for (int range = 0; range < 16; ++range) {
      const bool listed = aim <= 4 && range <= 4;
      EXPECT_EQ(Gate{}.one(switches(aim, range)), listed ? Verdict::kPass : Verdict::kOutOfRange)
          << aim << ' ' << range;
    }
  }
}

}  // namespace
}  // namespace pitwall::safety
