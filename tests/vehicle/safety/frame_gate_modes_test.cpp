// SPDX-License-Identifier: Apache-2.0
// What depends on the mode: how hard a stop may brake at a speed, how far it may steer, and what a
// car that stands may do at all.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/vehicle/safety/frame_gate_bench.hpp"
#include "tests/vehicle/safety/situation.hpp"
#include "vehicle/safety/frame_gate.hpp"

namespace pitwall::safety {
namespace {

using namespace testing;
using world::Mode;

constexpr std::array kArmedModes{Mode::kStandby,       Mode::kDriving, Mode::kControlledStop,
                                 Mode::kEmergencyStop, Mode::kHalted,  Mode::kCoast};
bool is_gentle(Mode mode) { return mode == Mode::kControlledStop || mode == Mode::kCoast; }
bool stands(Mode mode) { return mode == Mode::kStandby || mode == Mode::kHalted; }

// Stated here a second time: a limit moves only where two places say so.
TEST(FrameGateModes, WhatTheLimitsAreUnlessACarFileSaysOtherwise) {
  constexpr std::array<StopBrakeRow, 5> kBrake{
      {{0, 3050}, {20, 3210}, {40, 3700}, {60, 4510}, {80, 5640}}};
  const GateParams p;
  ASSERT_EQ(p.stop_brake.size(), kBrake.size());
  for (std::size_t i = 0; i < kBrake.size(); ++i) {
    EXPECT_EQ(p.stop_brake[i].speed_mps, kBrake[i].speed_mps);
    EXPECT_EQ(p.stop_brake[i].kpa, kBrake[i].kpa);
  }
  EXPECT_EQ(p.stop_steer_share, 0.85);
  EXPECT_EQ(p.hold_steer_slew_deg_per_s, 60.0);
  EXPECT_EQ(p.hold_least_kpa, 300.0);
}

// 350 kPa for 1 m/s^2; the front tyres lock at 0.65 of 1.3 (g + 0.0013 v^2). Never less, nor much
// more.
TEST(FrameGateModes, TheBrakeTableIsTheEllipseAtTheSpeed) {
  const GateParams p;
  for (double v = 0.0; v <= 80.0; v += 0.5) {
    const double grip_kpa = 350.0 * 0.65 * 1.3 * (9.81 + 0.0013 * v * v);
    EXPECT_GE(stop_brake_limit_kpa(p, v), grip_kpa) << v;
    EXPECT_LE(stop_brake_limit_kpa(p, v), 1.08 * grip_kpa) << v;
  }
}

TEST(FrameGateModes, BrakeLimitOfAnyTable) {
  Random random{6};
  for (int table = 0; table < 200; ++table) {
    GateParams p;
    double speed_mps = random.between(0.0, 5.0), kpa = random.between(1000.0, 3000.0);
    for (StopBrakeRow& row : p.stop_brake) {
      row = {speed_mps, kpa};
      speed_mps += random.between(0.5, 25.0);
      kpa += random.between(0.0, 900.0);
    }
    for (std::size_t i = 0; i < kStopBrakeRows; ++i)
      ASSERT_NEAR(stop_brake_limit_kpa(p, p.stop_brake[i].speed_mps), p.stop_brake[i].kpa, 1e-9);
    for (std::size_t i = 1; i < kStopBrakeRows; ++i) {
      const StopBrakeRow &a = p.stop_brake[i - 1], &b = p.stop_brake[i];
      const double share = random.between(0.0, 1.0);
      ASSERT_NEAR(stop_brake_limit_kpa(p, std::lerp(a.speed_mps, b.speed_mps, share)),
                  std::lerp(a.kpa, b.kpa, share), 1e-9);
    }
    EXPECT_EQ(stop_brake_limit_kpa(p, -5.0), p.stop_brake.front().kpa);
    EXPECT_NEAR(stop_brake_limit_kpa(p, 500.0), p.stop_brake.back().kpa, 1e-9);
    EXPECT_EQ(stop_brake_limit_kpa(p, kUnset), p.stop_brake.front().kpa) << "unknown is standing";
  }
}

TEST(FrameGateModes, AGentleStopBrakesUpToTheTableAndAnEmergencyBeyond) {
  for (const Mode mode : kArmedModes) {
    for (const double v : {0.0, 10.0, 20.0, 35.0, 50.0, 70.0, 90.0, kUnset}) {
      const GateParams p;
      const auto table_kpa = static_cast<int>(stop_brake_limit_kpa(p, v));
      for (const int kpa : {0, 1000, table_kpa - 1, table_kpa, table_kpa + 1, 5000, 6000, 6001}) {
        Gate g;
        g.context.mode = mode;
        g.context.speed_mps = v;
        const bool over = is_gentle(mode) && kpa > stop_brake_limit_kpa(p, v);
        EXPECT_EQ(g.one(brake(kpa)), over || kpa > 6000 ? Verdict::kOutOfRange : Verdict::kPass)
            << static_cast<int>(mode) << ' ' << v << ' ' << kpa;
      }
    }
  }
}

TEST(FrameGateModes, AHardBrakeMayComeDownInAGentleStopAndNeitherStayNorRise) {
  for (const Mode mode : {Mode::kControlledStop, Mode::kCoast}) {
    for (const int change : {-500, -1, 0, 1}) {
      Gate g;
      g.context.speed_mps = 20.0;
      ASSERT_EQ(g.one(brake(5000, 0)), Verdict::kPass) << "while it drove";
      g.wait(milliseconds(10));
      g.context.mode = mode;
      EXPECT_EQ(g.one(brake(5000 + change, 1)), change < 0 ? Verdict::kPass : Verdict::kOutOfRange)
          << change;
    }
    Gate g;
    g.context.speed_mps = 20.0;
    ASSERT_EQ(g.one(brake(5000, 0)), Verdict::kPass);
    g.context.mode = mode;
    for (int tick = 1, kpa = 4500; kpa > 3210; ++tick, kpa -= 500) {
      g.wait(milliseconds(10));
      ASSERT_EQ(g.one(brake(kpa, tick)), Verdict::kPass) << kpa;
    }
    g.wait(milliseconds(10));
    EXPECT_EQ(g.one(brake(3210, 20)), Verdict::kPass);
    g.wait(milliseconds(10));
    EXPECT_EQ(g.one(brake(3210, 21)), Verdict::kPass) << "within the table it may stay";
    g.wait(milliseconds(10));
    EXPECT_EQ(g.one(brake(3211, 22)), Verdict::kOutOfRange);
  }
}

TEST(FrameGateModes, StandingTheBrakeIsNotReleased) {
  for (const Mode mode : kArmedModes) {
    for (const int before : {0, 200, 300, 1500}) {
      for (const int kpa : {0, 199, 200, 201, 299, 300, 301, 1499}) {
        Gate g;
        g.context.speed_mps = 0.0;
        ASSERT_EQ(g.one(brake(before, 0)), Verdict::kPass);
        g.wait(seconds(1));
        g.context.mode = mode;
        const bool released = stands(mode) && kpa < 300 && kpa < before;
        EXPECT_EQ(g.one(brake(kpa, 1)), released ? Verdict::kBrakeReleased : Verdict::kPass)
            << static_cast<int>(mode) << ' ' << before << ' ' << kpa;
      }
    }
  }
}

TEST(FrameGateModes, AGentleStopSteersAShareOfTheTableAndAnEmergencyAllOfIt) {
  for (const Mode mode : kArmedModes) {
    for (const auto& [speed_mps, table_deg] : {SteerRow{0, 240}, {30, 165}, {60, 50}, {80, 33}}) {
      for (double deg = 0.0; deg <= 245.0; deg += 0.5) {
        for (const double side : {-1.0, 1.0}) {
          Gate g;
          g.context.mode = mode;
          g.context.speed_mps = speed_mps;
          const double limit_deg = is_gentle(mode) ? 0.85 * table_deg : table_deg;
          ASSERT_EQ(g.one(steer(side * deg)),
                    deg <= limit_deg ? Verdict::kPass : Verdict::kOutOfRange)
              << static_cast<int>(mode) << ' ' << speed_mps << ' ' << side * deg;
        }
      }
    }
  }
}

TEST(FrameGateModes, StandingTheWheelHardlyMoves) {
  for (const Mode mode : kArmedModes) {
    for (const std::int64_t ms : {10, 50, 100}) {
      const double per_s = stands(mode) ? 60.0 : 720.0;
      const double allowed_deg = per_s * 0.001 * static_cast<double>(ms) + 0.5;
      for (double change = -90.0; change <= 90.0; change += 0.5) {
        Gate g;
        g.context.speed_mps = 0.0;
        g.context.mode = mode;
        ASSERT_EQ(g.one(steer(10.0, 0)), Verdict::kPass);
        g.wait(milliseconds(ms));
        ASSERT_EQ(g.one(steer(10.0 + change, 1)),
                  std::abs(change) <= allowed_deg ? Verdict::kPass : Verdict::kTooFast)
            << static_cast<int>(mode) << ' ' << ms << ' ' << change;
      }
    }
  }
}

TEST(FrameGateModes, CoastingHasNoThrottleHoweverLittleAndHoweverMuchItWas) {
  for (const double before : {0.0, 50.0}) {
    for (const double percent : {0.0, 0.01, 10.0, 50.0}) {
      Gate g;
      ASSERT_EQ(g.one(throttle(before, 0)), Verdict::kPass);
      g.wait(milliseconds(100));
      g.context.mode = Mode::kCoast;
      EXPECT_EQ(g.one(throttle(percent, 1)),
                percent == 0.0 ? Verdict::kPass : Verdict::kThrottleForbidden);
    }
  }
}

// Every mode, speed, order and CT state: the engine goes off where the car stands, or nobody is
// armed, in an emergency, and where a stop's throttle stays open.
TEST(FrameGateModes, TheEngineGoesOffAtStandstillOnly) {
  for (const Mode mode : kAllModes) {
    for (const double v : {0.0, 1.0, 1.01, 30.0, 80.0, kUnset}) {
      for (const bool engine_off : {false, true}) {
        for (const int ct : {9, 10, 11, 12}) {
          Gate g;
          g.context.mode = mode;
          g.context.speed_mps = v;
          g.context.engine_off = engine_off;
          const bool stands = v <= 1.0 || mode == Mode::kStandby || mode == Mode::kHalted;
          const bool must = ct == 12 && (mode == Mode::kEmergencyStop ||
                                         (mode == Mode::kControlledStop && engine_off));
          const bool may = ct < 11 || stands || mode == Mode::kDisarmed || must;
          EXPECT_EQ(g.one(report(ct)), may ? Verdict::kPass : Verdict::kEngineOff)
              << static_cast<int>(mode) << ' ' << v << ' ' << engine_off << ' ' << ct;
        }
      }
    }
  }
}

// Nobody has to say that the throttle is well: who says nothing gets no engine-off while moving.
TEST(FrameGateModes, UnlessToldTheEngineStaysOnInAControlledStop) {
  Gate g;
  const GateContext unsaid;
  g.context.engine_off = unsaid.engine_off;
  g.context.mode = Mode::kControlledStop;
  g.context.speed_mps = 30.0;
  EXPECT_EQ(g.one(report(12)), Verdict::kEngineOff);
}

}  // namespace
}  // namespace pitwall::safety
