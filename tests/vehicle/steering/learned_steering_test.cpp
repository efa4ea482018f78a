// SPDX-License-Identifier: Apache-2.0
#include "vehicle/steering/learned_steering.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "protocol/vocabulary/random.hpp"
#include "tests/support/tick.hpp"

namespace pitwall::steering {
namespace {

constexpr LearningParams kParams;
constexpr Bicycle kModel;

// A steady-state bicycle of its own on an oval: straights banked 9 degrees, turns 20.
struct Car {
  double understeer = 0.0002, offset_rad = 0.0;
  double noise_rad_per_s = 0.0;
  Learned learned{};
  Random random{11};

  // The driver turns the wheel as far as this car needs, and not without moving it.
  void drive(double curvature_per_m, double bank_rad, double speed_mps) {
    const double fall_mps2 = kGravity_mps2 * std::sin(bank_rad);
    const double lateral = speed_mps * speed_mps * curvature_per_m - fall_mps2;
    const double needed = kModel.wheelbase_m * curvature_per_m + understeer * lateral + offset_rad;
    follow_command(kParams, learned, needed + random.between(-0.001, 0.001), kTick);
    const double rate = speed_mps * (learned.commanded_rad - offset_rad + understeer * fall_mps2) /
                        (kModel.wheelbase_m + understeer * speed_mps * speed_mps);
    const double seen = rate + noise_rad_per_s * random.between(-1.0, 1.0);
    learn(kParams, kModel, learned, {speed_mps, seen, bank_rad}, kTick);
  }
  void lap(double speed_mps) {
    for (const bool turn : {true, false})
      for (double s_m = 0.0; s_m < 700.0; s_m += speed_mps * kTick.seconds())
        drive(turn ? 1.0 / 220.0 : 0.0, from_deg(turn ? 20.0 : 9.0), speed_mps);
  }
};

bool same(const Learned& a, const Learned& b) {
  return a.commanded_rad == b.commanded_rad && a.offset_rad == b.offset_rad &&
         a.understeer_rad_per_mps2 == b.understeer_rad_per_mps2;
}

TEST(LearnedSteering, FindsTheOffsetAndTheGradientOfAnyCarOnAnOval) {
  for (double understeer = 0.0; understeer < 0.00251; understeer += 0.0005)
    for (const double offset_rad : {-0.006, 0.0, 0.006})
      for (const double noise : {0.0, 0.01}) {
        Car car{.understeer = understeer, .offset_rad = offset_rad, .noise_rad_per_s = noise};
        for (int i = 0; i < 16; ++i) car.lap(55.0);
        EXPECT_NEAR(car.learned.offset_rad, offset_rad, 0.0005) << understeer;
        EXPECT_NEAR(kModel.understeer_rad_per_mps2 + car.learned.understeer_rad_per_mps2,
                    understeer, 0.0001)
            << offset_rad;
      }
}

// Half a lap before a stop is what there may be: the angle of the turn itself is known early.
TEST(LearnedSteering, KnowsTheAngleOfATurnAfterTwelveSecondsInIt) {
  Car car{.understeer = 0.0018};
  for (int i = 0; i < 1200; ++i) car.drive(1.0 / 220.0, from_deg(20.0), 55.0);
  const double lateral = 55.0 * 55.0 / 220.0 - kGravity_mps2 * std::sin(from_deg(20.0));
  const double before = angle_rad(kModel, {}, 1.0 / 220.0, lateral);
  const double needed = kModel.wheelbase_m / 220.0 + 0.0018 * lateral;
  const double known = angle_rad(kModel, car.learned, 1.0 / 220.0, lateral);
  EXPECT_LT(std::abs(needed - known), 0.15 * std::abs(needed - before));
}

TEST(LearnedSteering, OnALevelStraightOnlyTheOffsetMoves) {
  Car car{.understeer = 0.002, .offset_rad = 0.003};
  car.learned.understeer_rad_per_mps2 = 0.0007;
  for (int i = 0; i < 12'000; ++i) {
    follow_command(kParams, car.learned, car.offset_rad, kTick);
    learn(kParams, kModel, car.learned, {60.0, 0.0, 0.0}, kTick);
    ASSERT_EQ(car.learned.understeer_rad_per_mps2, 0.0007);
  }
  EXPECT_NEAR(car.learned.offset_rad, 0.003, 1e-4);
}

TEST(LearnedSteering, WhatIsRightStaysSoWhereverTheCarDrives) {
  Car car{.understeer = 0.0015, .offset_rad = -0.002};
  car.learned = {-0.002, -0.002, 0.0013};
  Random random{3};
  for (int i = 0; i < 100'000; ++i) {
    const double v = random.between(15.0, 70.0);
    car.drive(random.between(-0.008, 0.008), random.between(-0.35, 0.35), v);
    ASSERT_NEAR(car.learned.offset_rad, -0.002, 1e-12);
    ASSERT_NEAR(car.learned.understeer_rad_per_mps2, 0.0013, 1e-12);
  }
}

TEST(LearnedSteering, StaysWithinItsLimitsForAnyInput) {
  const auto any = [](Random& random) {
    constexpr double kOdd[] = {kUnset, HUGE_VAL, -HUGE_VAL, 1e300, -1e300, 1e-300, 0.0};
    if (random.one_in(3)) return kOdd[random.below(7)];
    return random.between(-1.0, 1.0) * std::pow(10.0, random.between(-4.0, 4.0));
  };
  Random random{17};
  Learned learned;
  for (int i = 0; i < 300'000; ++i) {
    if (random.one_in(5000)) learned = {};
    const Duration dt{random.one_in(50) ? (random.one_in(2) ? -seconds(5).ns : seconds(900).ns)
                                        : static_cast<std::int64_t>(random.below(20'000'000))};
    follow_command(kParams, learned, any(random), dt);
    learn(kParams, kModel, learned, {any(random), any(random), any(random)}, dt);
    ASSERT_TRUE(std::isfinite(learned.commanded_rad)) << i;
    ASSERT_LE(std::abs(learned.offset_rad), 0.01) << i;
    ASSERT_GE(learned.understeer_rad_per_mps2, -0.0008) << i;
    ASSERT_LE(learned.understeer_rad_per_mps2, 0.003) << i;
  }
}

TEST(LearnedSteering, WhatIsNoNumberAndASlowCarChangeNothing) {
  const Learned before{0.02, 0.001, 0.0004};
  for (int field = 0; field < 3; ++field)
    for (const double bad : {kUnset, HUGE_VAL, -HUGE_VAL}) {
      Turning at{40.0, 0.2, 0.1};
      (field == 0 ? at.speed_mps : field == 1 ? at.yaw_rate_rad_per_s : at.bank_rad) = bad;
      Learned learned = before;
      learn(kParams, kModel, learned, at, kTick);
      EXPECT_TRUE(same(learned, before)) << field << ' ' << bad;
    }
  Learned learned = before;
  follow_command(kParams, learned, kUnset, kTick);
  EXPECT_TRUE(same(learned, before));
  for (const double slow_mps : {-30.0, 0.0, 5.0, 14.9}) {
    learn(kParams, kModel, learned, {slow_mps, 0.5, 0.2}, kTick);
    EXPECT_TRUE(same(learned, before)) << slow_mps;
  }
  learn(kParams, kModel, learned, {40.0, 0.2, 0.1}, kTick);
  EXPECT_FALSE(same(learned, before)) << "and a fast one does";
}

TEST(LearnedSteering, LeftAndRightAreMirrorImages) {
  Random random{23};
  Learned left, right;
  for (int i = 0; i < 20'000; ++i) {
    const double angle = random.between(-0.05, 0.05), rate = random.between(-0.4, 0.4),
                 bank = random.between(-0.35, 0.35), v = random.between(10.0, 70.0);
    follow_command(kParams, left, angle, kTick);
    follow_command(kParams, right, -angle, kTick);
    learn(kParams, kModel, left, {v, rate, bank}, kTick);
    learn(kParams, kModel, right, {v, -rate, -bank}, kTick);
    ASSERT_EQ(left.offset_rad, -right.offset_rad);
    ASSERT_EQ(left.understeer_rad_per_mps2, right.understeer_rad_per_mps2);
  }
}

TEST(LearnedSteering, TheCommandLagsByItsTimeWhateverTheTick) {
  for (const std::int64_t tick_ms : {1, 5, 10, 20}) {
    Learned learned;
    for (std::int64_t t = 0; t < 200; t += tick_ms)
      follow_command(kParams, learned, 0.03, milliseconds(tick_ms));
    EXPECT_NEAR(learned.commanded_rad, 0.03 * (1.0 - std::exp(-1.0)), 1e-12) << tick_ms;
  }
}

TEST(LearnedSteering, TheYawRateOfAnAngleIsTheOneThatNeedsIt) {
  Random random{29};
  for (int i = 0; i < 1000; ++i) {
    const Learned learned{0.0, random.between(-0.01, 0.01), random.between(-0.0002, 0.003)};
    const double v = random.between(1.0, 80.0), bank = random.between(-0.35, 0.35),
                 angle = random.between(-0.1, 0.1);
    const double rate = yaw_rate_rad_per_s(kModel, learned, angle, v, bank);
    EXPECT_NEAR(angle_rad(kModel, learned, rate / v, lateral_mps2({v, rate, bank})), angle, 1e-12);
  }
}

}  // namespace
}  // namespace pitwall::steering
