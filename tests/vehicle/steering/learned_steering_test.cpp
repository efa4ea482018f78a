// SPDX-License-Identifier: Apache-2.0
#include "vehicle/steering/learned_steering.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "protocol/vocabulary/random.hpp"
#include "tests/support/tick.hpp"

namespace pitwall::steering {
namespace {

constexpr LearningParams kParams;
constexpr Bicycle kModel;

// A steady-state bicycle of its own on an oval: straights banked 9 degrees, turns 20.
struct Car {
  double understeer = 0.0002, offset_rad = 0.0, bend = 0.0, lag_s = kParams.lag_s;
  double noise_rad_per_s = 0.0;
  Learned learned{};
  double turned_rad = 0.0;  // of the wheels
  Random random{11};

  double needed_rad(double curvature_per_m, double lateral) const {
    return kModel.wheelbase_m * curvature_per_m + understeer * lateral +
           bend * lateral * lateral * lateral + offset_rad;
  }
  // The yaw rate of the angle that the wheels have, by bisection.
  double rate_of(double angle_rad, double bank_rad, double speed_mps) const {
    double low = -2.0, high = 2.0;
    while (high - low > 1e-13) {
      const double middle = 0.5 * (low + high);
      const double needs =
          needed_rad(middle / speed_mps, lateral_mps2({speed_mps, middle, bank_rad}));
      (needs < angle_rad ? low : high) = middle;
    }
    return 0.5 * (low + high);
  }
  // The driver turns the wheel as far as this car needs, and not without moving it.
  void drive(double curvature_per_m, double bank_rad, double speed_mps) {
    const double lateral =
        speed_mps * speed_mps * curvature_per_m - kGravity_mps2 * std::sin(bank_rad);
    const double asked = needed_rad(curvature_per_m, lateral) + random.between(-0.001, 0.001);
    follow_command(kParams, learned, asked, kTick);
    turned_rad += (1.0 - std::exp(-kTick.seconds() / lag_s)) * (asked - turned_rad);
    const double seen =
        rate_of(turned_rad, bank_rad, speed_mps) + noise_rad_per_s * random.between(-1.0, 1.0);
    learn(kParams, kModel, learned, {speed_mps, seen, bank_rad}, kTick);
  }
  void lap(double speed_mps) {
    for (const bool turn : {true, false})
      for (double s_m = 0.0; s_m < 700.0; s_m += speed_mps * kTick.seconds())
        drive(turn ? 1.0 / 220.0 : 0.0, from_deg(turn ? 20.0 : 9.0), speed_mps);
  }
  // What was learned, against what is.
  double wrong_rad(double lateral) const {
    return angle_rad(kModel, learned, 0.0, lateral) - needed_rad(0.0, lateral);
  }
};

bool same(const Learned& a, const Learned& b) {
  return a.commanded_rad == b.commanded_rad && a.offset_rad == b.offset_rad &&
         a.understeer_rad_per_mps2 == b.understeer_rad_per_mps2 &&
         a.bend_rad_s6_per_m3 == b.bend_rad_s6_per_m3 && a.lag_s == b.lag_s &&
         a.rear_slip_rad_per_mps2 == b.rear_slip_rad_per_mps2;
}

TEST(LearnedSteering, FindsTheAngleThatAnyCarNeedsOnAnOval) {
  for (double understeer = 0.0; understeer < 0.00251; understeer += 0.0005)
    for (const double offset_rad : {-0.006, 0.0, 0.006})
      for (const double bend : {-3e-7, 0.0, 1.5e-6})
        for (const double noise : {0.0, 0.004}) {
          Car car{.understeer = understeer,
                  .offset_rad = offset_rad,
                  .bend = bend,
                  .noise_rad_per_s = noise};
          for (const double speed_mps : {30.0, 40.0, 50.0, 55.0, 60.0, 65.0}) car.lap(speed_mps);
          for (double lateral = -1.5; lateral < 15.0; lateral += 1.5)
            EXPECT_NEAR(car.wrong_rad(lateral), 0.0, 0.001)
                << understeer << ' ' << offset_rad << ' ' << bend << ' ' << noise << ' ' << lateral;
        }
}

// A car that nobody measured comes to its first corner.
TEST(LearnedSteering, KnowsTheAngleOfATurnAfterThreeSecondsInIt) {
  Car car{.understeer = 0.0018};
  const double lateral = 55.0 * 55.0 / 220.0 - kGravity_mps2 * std::sin(from_deg(20.0));
  const double before = car.wrong_rad(lateral);
  for (int i = 0; i < 300; ++i) car.drive(1.0 / 220.0, from_deg(20.0), 55.0);
  EXPECT_LT(std::abs(car.wrong_rad(lateral)), 0.15 * std::abs(before));
}

TEST(LearnedSteering, FindsTheLag) {
  for (const double lag_s : {0.10, 0.15, 0.22}) {
    Car car{.lag_s = lag_s};
    for (int i = 0; i < 10; ++i)
      for (const double curvature : {1.0 / 300.0, -1.0 / 300.0})
        for (int tick = 0; tick < 100; ++tick) car.drive(curvature, 0.0, 40.0);
    EXPECT_NEAR(kParams.lag_s + car.learned.lag_s, lag_s, 0.025);
  }
}

TEST(LearnedSteering, DoubtsWhatItHasNotSeen) {
  const auto doubt = [](const Learned& learned, double lateral) {
    return doubt_rad(kParams, kModel, learned, lateral);
  };
  Car car{.understeer = 0.0018};
  const double most = kParams.understeer_most_rad_per_mps2 - kModel.understeer_rad_per_mps2;
  EXPECT_NEAR(doubt(car.learned, 1.0), most, 1e-5);
  EXPECT_EQ(doubt(car.learned, 0.0), 0.0);
  car.lap(40.0);  // 3.9 m/s2
  const double seen = 3.9;
  EXPECT_LT(doubt(car.learned, seen), 0.1 * most * seen);
  EXPECT_GT(doubt(car.learned, 15.0), 3.0 * doubt(car.learned, seen));
  // It is no smaller than what is wrong.
  for (double lateral = 0.0; lateral < 16.0; lateral += 1.0)
    EXPECT_LE(std::abs(car.wrong_rad(lateral) - car.wrong_rad(0.0)),
              doubt(car.learned, lateral) + 1e-4);
}

// The same filter in whole matrices and in Joseph's form (Bar-Shalom et al., eq. 5.2.3-18).
TEST(LearnedSteering, IsTheKalmanFilterOfItsModel) {
  constexpr std::size_t n = 4;
  using Matrix = std::array<std::array<double, n>, n>;
  const double most = kParams.understeer_most_rad_per_mps2 - kModel.understeer_rad_per_mps2;
  const std::array first{kParams.offset_most_rad / 2.0, most / 2.0,
                         kParams.bend_most_rad_s6_per_m3 / 2.0, 0.05};
  const std::array drift{0.0005, 0.0001, 4e-7, 0.01};
  Matrix p{};
  std::array<double, n> x{};
  for (std::size_t i = 0; i < n; ++i) p[i][i] = first[i] * first[i];
  Car car{.understeer = 0.0012, .offset_rad = 0.001, .bend = 1e-6, .noise_rad_per_s = 0.005};
  Random random{5};
  double v = 30.0, bank = 0.0, curvature = 0.0;
  for (int tick = 0; tick < 3000; ++tick) {
    if (tick % 50 == 0) {
      v = random.between(20.0, 65.0);
      bank = random.between(0.0, 0.35);
      curvature = random.between(-1.0, 15.0) / (v * v);
    }
    const double level = v * v * curvature - kGravity_mps2 * std::sin(bank);
    follow_command(kParams, car.learned, car.needed_rad(curvature, level), kTick);
    const double rate =
        car.rate_of(car.learned.commanded_rad, bank, v) + random.between(-0.005, 0.005);
    const double a = lateral_mps2({v, rate, bank}), turning = car.learned.turning_rad_per_s;
    const double z = car.learned.commanded_rad - kModel.wheelbase_m * rate / v -
                     kModel.understeer_rad_per_mps2 * a;
    learn(kParams, kModel, car.learned, {v, rate, bank}, kTick);
    for (std::size_t i = 0; i < n; ++i) p[i][i] += drift[i] * drift[i] / 60.0 * kTick.seconds();
    const double bent = std::min(std::abs(a), 18.0);
    const std::array h{1.0, a, a * bent * bent, turning};
    const double r = (1e-6 + 0.01 * turning * turning) * 0.5 / kTick.seconds();
    double s = r, known = 1e-6 + 0.01 * turning * turning, predicted = 0.0;
    std::array<double, n> k{};
    for (std::size_t i = 0; i < n; ++i) {
      predicted += h[i] * x[i];
      for (std::size_t j = 0; j < n; ++j) k[i] += p[i][j] * h[j];
      s += h[i] * k[i];
      known += h[i] * k[i];
    }
    ASSERT_NEAR(car.learned.innovation_rad, z - predicted, 1e-9);
    ASSERT_NEAR(car.learned.innovation_sigma_rad, std::sqrt(known), 1e-9);
    Matrix left{}, next{};
    for (std::size_t i = 0; i < n; ++i) x[i] += k[i] / s * (z - predicted);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) left[i][j] = (i == j ? 1.0 : 0.0) - k[i] / s * h[j];
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) {
        next[i][j] = k[i] / s * r * k[j] / s;
        for (std::size_t l = 0; l < n; ++l)
          for (std::size_t m = 0; m < n; ++m) next[i][j] += left[i][l] * p[l][m] * left[j][m];
      }
    p = next;
    const Learned& is = car.learned;
    const std::array got{is.offset_rad, is.understeer_rad_per_mps2, is.bend_rad_s6_per_m3,
                         is.lag_s};
    const bool limited = std::abs(x[0]) > 0.009 || x[1] > 0.0029 || x[1] < -0.0007 || x[2] > 9e-6 ||
                         x[2] < -9e-7 || std::abs(x[3]) > 0.11;
    ASSERT_FALSE(limited) << tick << ' ' << x[0] << ' ' << x[1] << ' ' << x[2] << ' ' << x[3];
    for (std::size_t i = 0; i < n; ++i)
      ASSERT_NEAR(got[i], x[i], 1e-9 + 1e-6 * std::abs(x[i])) << i;
  }
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
  car.learned = {.commanded_rad = -0.002, .offset_rad = -0.002, .understeer_rad_per_mps2 = 0.0013};
  car.turned_rad = -0.002;
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
    learn(kParams, kModel, learned, {any(random), any(random), any(random), any(random)}, dt);
    ASSERT_TRUE(std::isfinite(learned.commanded_rad)) << i;
    ASSERT_LE(std::abs(learned.offset_rad), 0.01) << i;
    ASSERT_GE(learned.understeer_rad_per_mps2, -0.0008) << i;
    ASSERT_LE(learned.understeer_rad_per_mps2, 0.003) << i;
    ASSERT_GE(learned.rear_slip_rad_per_mps2, -0.0014) << i;
    ASSERT_LE(learned.rear_slip_rad_per_mps2, 0.004) << i;
  }
}

TEST(LearnedSteering, WhatIsNoNumberAndASlowCarChangeNothing) {
  const Learned before{
      .commanded_rad = 0.02, .offset_rad = 0.001, .understeer_rad_per_mps2 = 0.0004};
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
  EXPECT_TRUE(std::isnan(learned.innovation_rad + learned.innovation_sigma_rad));
  learn(kParams, kModel, learned, {40.0, 0.2, 0.1}, kTick);
  EXPECT_FALSE(same(learned, before)) << "and a fast one does";
  EXPECT_TRUE(std::isfinite(learned.innovation_rad + learned.innovation_sigma_rad));
  learn(kParams, kModel, learned, {14.9, 0.2, 0.1}, kTick);
  EXPECT_TRUE(std::isnan(learned.innovation_rad)) << "not the one of a tick before";
}

// A rear axle that slips by any gradient, seen through the noise of a localization: half a degree.
TEST(LearnedSteering, FindsTheSlipGradientOfTheRearAxleInAFewTurns) {
  for (const double gradient : {0.0005, 0.0014, 0.0025, 0.004}) {
    Learned learned;
    Random random{37};
    const double v = 60.0;
    for (int i = 0; i < 4000; ++i) {
      const double rate = i / 500 % 2 == 0 ? 0.25 : 0.0, bank = rate > 0.0 ? 0.16 : 0.0;
      const double slip_rad = kModel.cg_to_rear_m * rate / v -
                              gradient * lateral_mps2({v, rate, bank}) +
                              random.between(-0.0087, 0.0087);
      learn(kParams, kModel, learned, {v, rate, bank, v * slip_rad}, kTick);
    }
    const double found = kModel.rear_slip_rad_per_mps2 + learned.rear_slip_rad_per_mps2;
    EXPECT_NEAR(found, gradient, 0.0002) << gradient;
    const RoadLoad turn{v, 0.004, 0.1};
    EXPECT_NEAR(slip_rad(kModel, learned, turn),
                kModel.cg_to_rear_m * turn_per_m(turn) - found * lateral_demand_mps2(turn), 1e-12);
  }
}

TEST(LearnedSteering, ASlipThatIsNoNumberTakesNothingElseAway) {
  Learned with, without;
  learn(kParams, kModel, with, {40.0, 0.2, 0.1, -0.5}, kTick);
  learn(kParams, kModel, without, {40.0, 0.2, 0.1, kUnset}, kTick);
  EXPECT_EQ(with.offset_rad, without.offset_rad);
  EXPECT_EQ(with.lag_s, without.lag_s);
  EXPECT_NE(with.rear_slip_rad_per_mps2, 0.0);
  EXPECT_EQ(without.rear_slip_rad_per_mps2, 0.0);
}

TEST(LearnedSteering, LeftAndRightAreMirrorImages) {
  Random random{23};
  Learned left, right;
  for (int i = 0; i < 20'000; ++i) {
    const double angle = random.between(-0.05, 0.05), rate = random.between(-0.4, 0.4),
                 bank = random.between(-0.35, 0.35), v = random.between(10.0, 70.0);
    follow_command(kParams, left, angle, kTick);
    follow_command(kParams, right, -angle, kTick);
    const double slip = random.between(-3.0, 3.0);
    learn(kParams, kModel, left, {v, rate, bank, slip}, kTick);
    learn(kParams, kModel, right, {v, -rate, -bank, -slip}, kTick);
    ASSERT_EQ(left.rear_slip_rad_per_mps2, right.rear_slip_rad_per_mps2);
    ASSERT_EQ(left.offset_rad, -right.offset_rad);
    ASSERT_EQ(left.understeer_rad_per_mps2, right.understeer_rad_per_mps2);
  }
}

TEST(LearnedSteering, TheCommandLagsByItsTimeWhateverTheTick) {
  for (const std::int64_t tick_ms : {1, 5, 10, 20}) {
    Learned learned;
    for (std::int64_t t = 0; t < 200; t += tick_ms)
      follow_command(kParams, learned, 0.03, milliseconds(tick_ms));
    EXPECT_NEAR(learned.commanded_rad, 0.03 * (1.0 - std::exp(-0.2 / kParams.lag_s)), 1e-12)
        << tick_ms;
  }
}

TEST(LearnedSteering, TheYawRateOfAnAngleIsTheOneThatNeedsIt) {
  Random random{29};
  for (int i = 0; i < 1000; ++i) {
    const Learned learned{.offset_rad = random.between(-0.01, 0.01),
                          .understeer_rad_per_mps2 = random.between(0.0, 0.003),
                          .bend_rad_s6_per_m3 = random.between(-2e-7, 2e-6)};
    const double v = random.between(1.0, 80.0), bank = random.between(-0.35, 0.35);
    const double tightest = std::min(40.0 / (v * v), 0.1);
    const double rate = v * random.between(-tightest, tightest);
    const double angle = angle_rad(kModel, learned, rate / v, lateral_mps2({v, rate, bank}));
    EXPECT_NEAR(yaw_rate_rad_per_s(kModel, learned, angle, v, bank), rate, 1e-9) << v;
  }
  EXPECT_TRUE(std::isnan(yaw_rate_rad_per_s(kModel, {}, kUnset, 30.0, 0.0)));
}

}  // namespace
}  // namespace pitwall::steering
