// SPDX-License-Identifier: Apache-2.0
#include "vehicle/steering/path_steering.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "protocol/vocabulary/random.hpp"
#include "tests/vehicle/steering/linear_car.hpp"

namespace pitwall::steering {
namespace {

using testing::CarCase;
using testing::settle;
using testing::Settling;
using testing::stiff;

SteeringInputs some(Random& random) {
  return {.deviation = {random.between(-3.0, 3.0), random.between(-0.2, 0.2),
                        random.between(-0.008, 0.008), random.between(-0.35, 0.35)},
          .ahead = {random.between(-0.008, 0.008), random.between(-0.35, 0.35),
                    random.between(-0.008, 0.008)},
          .speed_mps = random.between(0.6, 75.0),
          .yaw_rate_rad_per_s = random.one_in(4) ? kUnset : random.between(-0.5, 0.5),
          .last_angle_rad = random.between(-0.08, 0.08),
          .angle_max_rad = random.between(0.08, 0.2)};
}

Learned some_learned(Random& random) {
  return {.commanded_rad = random.between(-0.05, 0.05),
          .offset_rad = random.between(-0.01, 0.01),
          .understeer_rad_per_mps2 = random.between(-0.0008, 0.003)};
}

template <class Fn>
void each_car(Fn fn) {
  for (const double speed_mps : {15.0, 30.0, 45.0, 65.0})
    for (const double understeer : {0.0, 0.0002, 0.0008, 0.0016, 0.0025})
      for (const double tyre_share : {1.0, 0.5})
        for (const double delay_s : {0.02, 0.08})
          for (const double lag_s : {0.04, 0.1})
            for (const bool learned : {true, false})
              fn(CarCase{speed_mps, understeer, tyre_share, delay_s, lag_s, learned});
}

std::string text_of(const CarCase& c) {
  return std::to_string(c.speed_mps) + " m/s, understeer " + std::to_string(c.understeer) +
         ", tyres " + std::to_string(c.tyre_share) + ", delay " + std::to_string(c.delay_s) +
         ", lag " + std::to_string(c.lag_s) + (c.learned ? ", learned" : "");
}

TEST(PathSteering, EveryCarComesBackFromAMetreBesideWithoutSwinging) {
  each_car([](const CarCase& c) {
    const Settling s = settle({}, c, 1.0);
    EXPECT_LT(s.worst_m[0], 1.2) << text_of(c);
    EXPECT_LT(s.worst_m[2], 0.3) << text_of(c);
    EXPECT_LT(s.worst_m[5], 0.1) << text_of(c);
    for (std::size_t i = 1; i < s.worst_m.size(); ++i)
      EXPECT_LE(s.worst_m[i], std::max(s.worst_m[i - 1], 0.05)) << text_of(c) << ' ' << i;
    EXPECT_LT(s.angle_rate_late_rad_per_s, 0.005) << text_of(c);
  });
}

// The test above can fail.
TEST(PathSteering, AStifferLawWithoutLeadSwingsUpOnCarsOfTheFamily) {
  int swings = 0;
  each_car([&](const CarCase& c) {
    const Settling s = settle(stiff(), c, 1.0);
    swings += s.worst_m[5] > 1.0;
  });
  EXPECT_GT(swings, 0);
}

TEST(PathSteering, BeginsWithTheLastAngleWhoeverSteeredBefore) {
  Random random{41};
  for (int i = 0; i < 2000; ++i) {
    State state;
    const SteeringInputs in = some(random);
    EXPECT_NEAR(steer({}, some_learned(random), state, in, kTick), in.last_angle_rad, 1e-12);
    EXPECT_TRUE(state.begun);
  }
}

// What was taken over is forgotten: two that began with other angles steer alike in the end.
TEST(PathSteering, TheDifferenceOfTheBeginDecays) {
  const Params p;
  State one, other;
  SteeringInputs in{.deviation = {0.0, 0.0, 0.002, 0.1},
                    .ahead = {0.002, 0.1, 0.002},
                    .speed_mps = 40.0,
                    .yaw_rate_rad_per_s = kUnset,
                    .angle_max_rad = 0.2};
  double apart_rad = 0.0;
  for (int i = 0; i <= 500; ++i) {
    in.last_angle_rad = 0.03;
    const double a = steer(p, {}, one, in, kTick);
    in.last_angle_rad = -0.01;
    const double b = steer(p, {}, other, in, kTick);
    apart_rad = a - b;
    ASSERT_NEAR(apart_rad, 0.04 * std::exp(-0.01 * i / p.settle_s), 1e-9) << i;
  }
}

TEST(PathSteering, StaysWithinTheAngleForAnyInput) {
  Random random{43};
  State state;
  double last_rad = 0.0;
  for (int i = 0; i < 100'000; ++i) {
    if (random.one_in(500)) state = {};
    SteeringInputs in = some(random);
    const double wild = std::pow(10.0, random.between(0.0, 6.0));
    in.deviation.lateral_m *= wild;
    in.ahead.yaw_per_m *= wild;
    in.last_angle_rad = last_rad;
    last_rad = steer({}, some_learned(random), state, in, kTick);
    ASSERT_LE(std::abs(last_rad), in.angle_max_rad) << i;
  }
}

TEST(PathSteering, WhereTheCarHardlyRollsTheWheelsStay) {
  const Params p;
  Random random{47};
  State state;
  for (int i = 0; i < 1000; ++i) {
    SteeringInputs in = some(random);
    in.speed_mps = random.between(-1.0, p.hold_speed_mps - 1e-6);
    const double trim_rad = state.trim_rad;
    EXPECT_EQ(steer(p, {}, state, in, kTick), in.last_angle_rad);
    EXPECT_EQ(state.trim_rad, trim_rad);
  }
}

TEST(PathSteering, TheTrimDoesNotWindUpAtTheLimit) {
  for (const double side : {-1.0, 1.0}) {
    const Params p;
    State state;
    SteeringInputs in{.deviation = {-30.0 * side, 0.0, 0.0, 0.0},
                      .ahead = {0.0, 0.0, 0.0},
                      .speed_mps = 40.0,
                      .yaw_rate_rad_per_s = kUnset,
                      .angle_max_rad = 0.05};
    for (int i = 0; i < 200; ++i) in.last_angle_rad = steer(p, {}, state, in, kTick);
    ASSERT_EQ(in.last_angle_rad, 0.05 * side);
    const double trim_rad = state.trim_rad;
    for (int i = 0; i < 6000; ++i) in.last_angle_rad = steer(p, {}, state, in, kTick);
    EXPECT_EQ(state.trim_rad, trim_rad);
  }
}

TEST(PathSteering, TheTrimFindsWhatStaysAndStaysWithinItsOwnLimit) {
  const Params p;
  State state;
  SteeringInputs in{.deviation = {0.4, 0.0, 0.0, 0.0},
                    .ahead = {0.0, 0.0, 0.0},
                    .speed_mps = 20.0,
                    .yaw_rate_rad_per_s = kUnset,
                    .angle_max_rad = 0.2};
  double last_trim = 0.0;
  for (int i = 0; i < 60'000; ++i) {
    in.last_angle_rad = steer(p, {}, state, in, kTick);
    ASSERT_LE(state.trim_rad, last_trim) << "against the side it stands on";
    ASSERT_GE(state.trim_rad, -p.correction_max_rad);
    last_trim = state.trim_rad;
  }
  EXPECT_EQ(last_trim, -p.correction_max_rad);
}

TEST(PathSteering, WhatIsNoNumberLeavesTheLastAngleAndIsForgotten) {
  for (int field = 0; field < 8; ++field)
    for (const double bad : {kUnset, HUGE_VAL, -HUGE_VAL}) {
      Random random{53};
      State state;
      SteeringInputs in = some(random);
      in.speed_mps = 40.0, in.yaw_rate_rad_per_s = 0.1;
      in.last_angle_rad = steer({}, {}, state, in, kTick);
      SteeringInputs odd = in;
      double* const fields[] = {&odd.deviation.lateral_m,       &odd.deviation.course_rad,
                                &odd.deviation.curvature_per_m, &odd.deviation.bank_rad,
                                &odd.ahead.yaw_per_m,           &odd.ahead.bank_rad,
                                &odd.ahead.yaw_per_m_here,      &odd.speed_mps};
      if (field == 7 && bad < 0.0) continue;  // backwards is standing
      *fields[field] = bad;
      EXPECT_EQ(steer({}, {}, state, odd, kTick), in.last_angle_rad) << field << ' ' << bad;
      State fresh;
      EXPECT_EQ(steer({}, {}, fresh, odd, kTick), in.last_angle_rad) << field << ' ' << bad;
      EXPECT_FALSE(fresh.begun) << field << ' ' << bad;
      in.last_angle_rad = steer({}, {}, state, in, kTick);
      EXPECT_TRUE(std::isfinite(state.unknown_rad + state.trim_rad + state.bump_rad)) << field;
      EXPECT_TRUE(std::isfinite(in.last_angle_rad)) << field;
    }
}

// Without a yaw rate it steers as if the car turned with its path.
TEST(PathSteering, ACarWithoutYawRateTurnsAsItsPath) {
  Random random{59};
  for (int i = 0; i < 500; ++i) {
    SteeringInputs with = some(random), without;
    Params p;
    p.observer_share = 0.0;
    const Deviation& at = with.deviation;
    const double v_mps = std::max(with.speed_mps, p.gain_speed_least_mps);
    with.yaw_rate_rad_per_s = v_mps * with.ahead.yaw_per_m_here * std::cos(at.bank_rad);
    without = with;
    without.yaw_rate_rad_per_s = kUnset;
    State a, b;
    a.begun = b.begun = true;
    EXPECT_NEAR(steer(p, {}, a, with, kTick), steer(p, {}, b, without, kTick), 1e-12);
  }
}

TEST(PathSteering, LeftAndRightAreMirrorImages) {
  Random random{61};
  State left, right;
  for (int i = 0; i < 20'000; ++i) {
    if (random.one_in(300)) left = right = {};
    const SteeringInputs in = some(random);
    SteeringInputs mirrored = in;
    mirrored.deviation = {-in.deviation.lateral_m, -in.deviation.course_rad,
                          -in.deviation.curvature_per_m, -in.deviation.bank_rad};
    mirrored.ahead = {-in.ahead.yaw_per_m, -in.ahead.bank_rad, -in.ahead.yaw_per_m_here};
    mirrored.yaw_rate_rad_per_s = -in.yaw_rate_rad_per_s;
    mirrored.last_angle_rad = -in.last_angle_rad;
    const Learned learned = some_learned(random);
    Learned other = learned;
    other.commanded_rad = -learned.commanded_rad;
    other.turning_rad_per_s = -learned.turning_rad_per_s;
    other.offset_rad = -learned.offset_rad;
    ASSERT_EQ(steer({}, learned, left, in, kTick), -steer({}, other, right, mirrored, kTick)) << i;
  }
}

// On its path, with the car that the law believes in: the angle of the steady-state bicycle.
TEST(PathSteering, OnThePathItIsTheFeedForwardAlone) {
  Random random{67};
  for (int i = 0; i < 1000; ++i) {
    SteeringInputs in = some(random);
    in.deviation.lateral_m = in.deviation.course_rad = 0.0;
    in.yaw_rate_rad_per_s = kUnset;
    in.angle_max_rad = 1.0;
    const Learned learned = some_learned(random);
    State state;
    state.begun = true;
    const double v = in.speed_mps, bank = in.ahead.bank_rad;
    const double k = in.ahead.yaw_per_m * std::cos(bank);
    const double expected =
        2.971 * k + learned.offset_rad +
        (0.0002 + learned.understeer_rad_per_mps2) * (v * v * k - 9.80665 * std::sin(bank));
    EXPECT_NEAR(steer({}, learned, state, in, kTick), expected, 1e-9);
  }
}

// The slip angle of the rear axle's gradient grows into a turn: yaw is course minus slip.
TEST(PathSteering, TheCarYawsByWhatPathAndSlipAskOfIt) {
  Random random{71};
  for (int i = 0; i < 200; ++i) {
    Params p;
    p.bicycle.rear_slip_rad_per_mps2 = random.between(0.0, 0.003);
    const Learned learned{.lag_s = random.between(-0.1, 0.1),
                          .rear_slip_rad_per_mps2 = random.between(-0.001, 0.002)};
    const double v = random.between(10.0, 70.0), rise = random.between(-5e-5, 5e-5),
                 bank_rise = random.between(-2e-3, 2e-3);
    const double lag_s = p.learning.lag_s + learned.lag_s;
    const auto curvature_at = [&](double s_m) { return 0.001 + rise * s_m; };
    const auto road_at = [&](double s_m) -> RoadPoint {
      return {curvature_at(s_m), bank_rise * s_m};
    };
    const auto expected_at = [&](double s_m) {
      constexpr double kStep_m = 1e-3;
      const auto slip_at = [&](double at_m) {
        const double k = curvature_at(at_m) * std::cos(bank_rise * at_m);
        const double gradient = p.bicycle.rear_slip_rad_per_mps2 + learned.rear_slip_rad_per_mps2;
        return p.bicycle.cg_to_rear_m * k -
               gradient * (v * v * k - 9.80665 * std::sin(bank_rise * at_m));
      };
      return curvature_at(s_m) - (slip_at(s_m + kStep_m) - slip_at(s_m)) / kStep_m;
    };
    const PathAhead ahead = path_ahead(p, learned, v, road_at);
    EXPECT_NEAR(ahead.yaw_per_m, expected_at(v * lag_s), 1e-6);
    EXPECT_NEAR(ahead.yaw_per_m_here, expected_at(0.0), 1e-6);
    EXPECT_NEAR(ahead.bank_rad, bank_rise * v * lag_s, 1e-15);
  }
}

}  // namespace
}  // namespace pitwall::steering
