// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/control/lap_learning.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "protocol/vocabulary/random.hpp"
#include "tests/support/tick.hpp"
#include "tests/vehicle/autonomy/control/single_track.hpp"
#include "tests/vehicle/steering/linear_car.hpp"
#include "vehicle/autonomy/control/lqr_ff.hpp"

namespace pitwall::control {
namespace {

using testing::recommended;

constexpr double kLength_m = 2400.0, kSpeed_mps = 65.0;

struct Learner {
  Params params = recommended();
  LqrGains gains = design(params.lqr_ff, params.bicycle).value();
  LapState state;

  double operator()(const LapInputs& in) {
    return learn_lap(params.lap, params.steering, gains, state, in, kTick);
  }
};

LapInputs at(double s_m, double lateral_m, double speed_mps = kSpeed_mps) {
  return {.s_m = s_m,
          .length_m = kLength_m,
          .speed_mps = speed_mps,
          .lateral_m = lateral_m,
          .drives = true,
          .teaches = true};
}

// Half a metre to the left in a turn, on one half of the lap.
double in_a_turn(double s_m) {
  const double share = std::fmod(s_m + kLength_m, kLength_m) / kLength_m;
  return share < 0.5 ? 0.5 * std::sin(2.0 * std::numbers::pi * share) : 0.0;
}

// The angles of a drive from one station to another; `change` may change an input.
template <class Change>
std::vector<double> drive(Learner& learner, double from_m, double to_m, const Change& change,
                          double speed_mps = kSpeed_mps) {
  std::vector<double> angles;
  for (double s_m = from_m; s_m < to_m; s_m += speed_mps * kTick.seconds()) {
    LapInputs in = at(s_m, in_a_turn(s_m), speed_mps);
    change(in);
    angles.push_back(learner(in));
  }
  return angles;
}
std::vector<double> drive(Learner& learner, double from_m, double to_m,
                          double speed_mps = kSpeed_mps) {
  return drive(
      learner, from_m, to_m, [](LapInputs&) {}, speed_mps);
}

double largest(const std::vector<double>& angles) {
  double most = 0.0;
  for (const double a : angles) most = std::max(most, std::abs(a));
  return most;
}

constexpr double kRunIn_m = 300.0, kTaught_m = kLength_m + kRunIn_m;

TEST(LapLearning, SteersAgainstTheErrorOfTheLapBefore) {
  Learner learner;
  EXPECT_EQ(largest(drive(learner, -kRunIn_m, kLength_m - kRunIn_m)), 0.0);
  drive(learner, kLength_m - kRunIn_m, 2.0 * kLength_m - kRunIn_m);
  const double quarter_m = 0.25 * kLength_m;
  const double angle_rad = drive(learner, 2.0 * kLength_m, 2.0 * kLength_m + quarter_m).back();
  EXPECT_LT(angle_rad, -1e-3) << "to the right of a car that was left of its line";
}

TEST(LapLearning, IsOffWithoutAGain) {
  Learner learner;
  drive(learner, -kRunIn_m, kTaught_m);
  learner.params.lap.gain = 0.0;
  drive(learner, kTaught_m, kTaught_m + 100.0);
  EXPECT_EQ(largest(drive(learner, kTaught_m + 100.0, 2.0 * kLength_m)), 0.0);
}

TEST(LapLearning, StaysWithinItsAngleAndItsSlewWhateverHappens) {
  Learner learner;
  const LapParams& p = learner.params.lap;
  Random random{3};
  double last_rad = 0.0, most_rad = 0.0, s_m = 0.0;
  for (int i = 0; i < 60'000; ++i) {
    const double speed_mps = i % 20'000 < 19'000 ? kSpeed_mps : random.between(0.0, 90.0);
    s_m = i % 7'000 == 0 ? random.between(0.0, kLength_m) : s_m + speed_mps * kTick.seconds();
    LapInputs in = at(s_m, 4.0 * in_a_turn(s_m) + random.between(-0.5, 0.5), speed_mps);
    in.drives = i % 5'000 > 300;
    in.teaches = i % 9'000 > 500;
    const double angle_rad = learner(in);
    EXPECT_LE(std::abs(angle_rad), p.angle_max_rad + 1e-9);
    EXPECT_LE(std::abs(angle_rad - last_rad), p.slew_rad_per_s * kTick.seconds() + 1e-9);
    last_rad = angle_rad;
    most_rad = std::max(most_rad, std::abs(angle_rad));
  }
  EXPECT_GT(most_rad, 0.9 * p.angle_max_rad) << "the limit was reached";
}

TEST(LapLearning, IsForTheSpeedThatTaughtIt) {
  Learner taught;
  drive(taught, -kRunIn_m, kTaught_m);
  const auto most_at = [&](double share) {
    Learner learner = taught;
    learner.params.lap.slew_rad_per_s = 0.2;
    return largest(drive(
        learner, kTaught_m, 2.0 * kLength_m, [](LapInputs& in) { in.teaches = false; },
        share * kSpeed_mps));
  };
  const double all_rad = most_at(1.0), share = taught.params.lap.speed_share;
  EXPECT_GT(all_rad, 1e-3);
  for (const double sign : {-1.0, 1.0}) {
    EXPECT_NEAR(most_at(1.0 + 0.49 * sign * share), all_rad, 0.02 * all_rad);
    EXPECT_NEAR(most_at(1.0 + 0.75 * sign * share), 0.5 * all_rad, 0.02 * all_rad);
    EXPECT_EQ(most_at(1.0 + 1.01 * sign * share), 0.0);
  }
}

TEST(LapLearning, ChangesNothingThatLiesAhead) {
  Learner learner;
  drive(learner, -kRunIn_m, kTaught_m);
  for (double s_m = kTaught_m; s_m < 3.0 * kLength_m; s_m += kSpeed_mps * kTick.seconds()) {
    const LapState before = learner.state;
    learner(at(s_m, in_a_turn(s_m)));
    const double bin = std::fmod(s_m / kLength_m, 1.0) * kLapBins;
    for (std::size_t i = 0; i < kLapBins; ++i) {
      if (learner.state.angle_rad[i] == before.angle_rad[i]) continue;
      const double behind = std::fmod(bin - static_cast<double>(i) + kLapBins, 1.0 * kLapBins);
      EXPECT_GT(behind, kLapReach) << s_m;
      EXPECT_LT(behind, kLapReach + 2) << s_m;
    }
  }
}

TEST(LapLearning, WhatIsNoLessonTeachesNothing) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const auto taught_by = [](const auto& change) {
    Learner learner;
    drive(learner, -kRunIn_m, kTaught_m, change);
    return largest(drive(learner, kTaught_m, 2.0 * kLength_m));
  };
  EXPECT_GT(taught_by([](LapInputs&) {}), 1e-3);
  EXPECT_EQ(taught_by([](LapInputs& in) { in.teaches = false; }), 0.0);
  EXPECT_EQ(taught_by([](LapInputs& in) { in.drives = false; }), 0.0);
  EXPECT_EQ(taught_by([](LapInputs& in) { in.s_m = kNone; }), 0.0);
  EXPECT_EQ(taught_by([](LapInputs& in) { in.length_m = kNone; }), 0.0);
  EXPECT_EQ(taught_by([](LapInputs& in) { in.lateral_m = kNone; }), 0.0);
  EXPECT_EQ(taught_by([](LapInputs& in) { in.speed_mps = 11.0; }), 0.0);
  // A lap of which a part is missing before each bin is whole around.
  EXPECT_EQ(
      taught_by([](LapInputs& in) { in.teaches = std::fmod(in.s_m + kLength_m, 150.0) > 5.0; }),
      0.0);
}

TEST(LapLearning, AnotherLineBeginsAnew) {
  Learner learner;
  drive(learner, -kRunIn_m, kTaught_m);
  const auto longer = [](LapInputs& in) { in.length_m = kLength_m + 20.0; };
  drive(learner, kTaught_m, kTaught_m + 100.0, longer);
  EXPECT_EQ(largest(drive(learner, kTaught_m + 100.0, kTaught_m + 600.0, longer)), 0.0);
}

// A linear car of another understeer, under the law, on a road that turns its wheels by up to a
// milliradian, each lap in the same places.
double error_of_lap(int lap, double gain) {
  Learner learner;
  learner.params.lap.gain = gain;
  const steering::Params& p = learner.params.steering;
  steering::testing::LinearCar car{{.speed_mps = kSpeed_mps, .understeer = 0.001}};
  steering::Learned learned;
  learned.understeer_rad_per_mps2 = 0.001 - p.bicycle.understeer_rad_per_mps2;
  LqrState law;
  double last_rad = 0.0, sum_m = 0.0;
  int ticks = 0;
  for (double s_m = -kRunIn_m; s_m < (lap + 1) * kLength_m; s_m += kSpeed_mps * kTick.seconds()) {
    const double lap_rad = learner(at(s_m, car.y_m));
    const LqrInputs in{.path = {.deviation = {car.y_m, car.course_rad(), 0.0, 0.0},
                                .ahead = {0.0, 0.0, 0.0},
                                .speed_mps = kSpeed_mps,
                                .yaw_rate_rad_per_s = car.yaw_rate_rad_per_s,
                                .last_angle_rad = last_rad,
                                .angle_max_rad = 0.2},
                       .slip_mps = car.vy_mps,
                       .lap_rad = lap_rad};
    last_rad = steer_lqr(p, learner.gains, learned, law, in, kTick);
    const double turn = 2.0 * std::numbers::pi * s_m / kLength_m;
    car.tick(last_rad + 0.0005 * (std::sin(4.0 * turn) + std::sin(9.0 * turn)));
    if (s_m < lap * kLength_m) continue;
    sum_m += std::abs(car.y_m);
    ++ticks;
  }
  return sum_m / ticks;
}

// By the factor of a lap of lap_convergence_test.cpp: three laps have taught the fourth.
TEST(LapLearning, WhatRepeatsFallsToAFifthInThreeLaps) {
  const double without_m = error_of_lap(3, 0.0), with_m = error_of_lap(3, recommended().lap.gain);
  EXPECT_GT(without_m, 0.03);
  EXPECT_LT(with_m, 0.216 * without_m);
}

}  // namespace
}  // namespace pitwall::control
