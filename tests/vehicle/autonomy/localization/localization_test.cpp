// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/localization/localization.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "tests/support/allocation_guard.hpp"
#include "tests/vehicle/autonomy/localization/drive.hpp"

namespace pitwall::localization {
namespace {

using testing::banked_turn;
using testing::Course;
using testing::Rig;
using world::Validity;

Rig rig_on(const Course& course, std::uint64_t seed = 1) {
  Rig rig;
  rig.course = course;
  rig.random.state = seed;
  return rig;
}

const Tally& tally(const Rig& rig, Source source, std::size_t unit) {
  return rig.state.tally[static_cast<std::size_t>(source)][unit];
}

std::uint32_t count(const Rig& rig, Source source, std::size_t unit, Gate gate) {
  return tally(rig, source, unit).by_gate[static_cast<std::size_t>(gate)];
}

TEST(Localization, FindsTheCarOnStraightsTurnsAndAtRest) {
  Course at_rest{.vx_mps = 0.0};
  for (const Course& course : {Course{}, banked_turn(55.0), banked_turn(20.0), at_rest}) {
    Rig rig = rig_on(course);
    rig.run(6.0);
    double error2 = 0.0, yaw2 = 0.0, speed2 = 0.0;
    for (int i = 0; i < 1000; ++i) {
      const world::EgoState ego = rig.tick().ego, truth = rig.truth();
      ASSERT_EQ(ego.validity, Validity::kGood);
      ASSERT_EQ(ego.at, Instant{rig.ms * 1'000'000});
      error2 += std::pow(rig.position_error_m(), 2);
      yaw2 += std::pow(wrap_pi(ego.yaw_rad - truth.yaw_rad), 2);
      speed2 += std::pow(ego.vx_mps - truth.vx_mps, 2) + std::pow(ego.vy_mps - truth.vy_mps, 2);
    }
    EXPECT_LT(std::sqrt(error2 / 1000.0), 0.03) << course.vx_mps;
    EXPECT_LT(std::sqrt(yaw2 / 1000.0), from_deg(0.2)) << course.vx_mps;
    EXPECT_LT(std::sqrt(speed2 / 1000.0), 0.15) << course.vx_mps;
  }
}

TEST(Localization, LearnsTheGyroBias) {
  Rig rig = rig_on(Course{});
  rig.sensors.gyro_bias_rad_per_s = -0.01;
  rig.run(60.0);
  EXPECT_NEAR(rig.out.gyro_bias_rad_per_s, -0.01, 0.002);
}

TEST(Localization, CovarianceIsHonest) {
  // Mean of the normalised error squared of (x, y, yaw) over many runs; a consistent filter has 3.
  double sum = 0.0;
  int runs = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Rig rig = rig_on(seed % 2 == 0 ? banked_turn() : Course{}, seed * 7919);
    rig.run(4.0 + 0.01 * static_cast<double>(seed));
    const world::EgoState truth = rig.truth();
    Belief b = rig.state.timeline.newest();
    advance(b, rig.params.timeline.noise, rig.out.ego.at);
    const Matrix6 p = Eigen::Map<const Matrix6>(b.covariance.data());
    const Eigen::Vector3d e(rig.out.ego.x_m - truth.x_m, rig.out.ego.y_m - truth.y_m,
                            wrap_pi(rig.out.ego.yaw_rad - truth.yaw_rad));
    sum += e.dot(p.topLeftCorner<3, 3>().inverse() * e);
    ++runs;
  }
  EXPECT_LT(sum / runs, 4.5);  // not overconfident
  EXPECT_GT(sum / runs, 0.3);  // nor useless: sensors are better than their floors say
}

TEST(Localization, StartsOnlyWithPositionAndHeading) {
  Rig rig = rig_on(Course{.vx_mps = 0.0});
  const auto at_start = rig.tick();
  EXPECT_EQ(at_start.ego.validity, Validity::kNever);
  EXPECT_TRUE(std::isnan(at_start.ego.x_m));
  for (int i = 0; i < 12; ++i) EXPECT_EQ(rig.tick().ego.validity, Validity::kNever) << i;
  EXPECT_GT(count(rig, Source::kPosition, 0, Gate::kNotStarted), 0u);
  rig.run(0.5);  // the first heading is true at 0.1 s and arrives at 0.15 s
  EXPECT_EQ(rig.out.ego.validity, Validity::kGood);
}

TEST(Localization, RefusesOutliersAndSaysSo) {
  Rig rig = rig_on(banked_turn());
  rig.run(5.0);
  const std::uint32_t before = count(rig, Source::kPosition, 1, Gate::kOutlier);
  rig.sensors.bias_east_m[1] = 0.5;
  rig.run(5.0);
  EXPECT_GE(count(rig, Source::kPosition, 1, Gate::kOutlier) - before, 95u);  // of 100
  EXPECT_EQ(count(rig, Source::kPosition, 0, Gate::kOutlier), 0u);
  EXPECT_LT(rig.position_error_m(), 0.10);
  EXPECT_EQ(rig.out.ego.validity, Validity::kGood);
  EXPECT_EQ(rig.state.restarts, 0u);
}

TEST(Localization, GoesOnWithEitherUnit) {
  for (const std::size_t lost : {0u, 1u}) {
    Rig rig = rig_on(banked_turn());
    rig.run(5.0);
    rig.sensors.unit_silent[lost] = true;  // with its IMU
    for (int i = 0; i < 1000; ++i) {
      ASSERT_EQ(rig.tick().ego.validity, Validity::kGood) << lost;
      ASSERT_LT(rig.position_error_m(), 0.15) << lost;
    }
  }
}

TEST(Localization, DeadReckonsThenIsLostThenRecovers) {
  Rig rig = rig_on(banked_turn());
  rig.run(10.0);
  rig.sensors.no_fix = true;
  rig.run(0.5);
  EXPECT_EQ(rig.out.ego.validity, Validity::kDeadReckoning);
  const double sigma_before = rig.out.ego.position_sigma_m;
  rig.run(1.5);
  EXPECT_LT(rig.position_error_m(), 0.5);  // after 2 s
  rig.run(3.0);
  EXPECT_LT(rig.position_error_m(), 1.5);  // after 5 s
  EXPECT_GT(rig.out.ego.position_sigma_m, sigma_before);
  EXPECT_GT(count(rig, Source::kPosition, 0, Gate::kNotSolved), 0u);
  rig.run(11.0);
  EXPECT_EQ(rig.out.ego.validity, Validity::kLost);
  EXPECT_TRUE(std::isfinite(rig.out.ego.x_m));  // still an answer
  rig.sensors.no_fix = false;
  rig.run(4.0);
  EXPECT_EQ(rig.out.ego.validity, Validity::kGood);
  EXPECT_LT(rig.position_error_m(), 0.1);
}

TEST(Localization, AWrongBeliefIsGivenUp) {
  Rig rig = rig_on(Course{});
  rig.run(5.0);
  rig.course.x0_m += 30.0;  // the world moves, both receivers agree
  rig.run(4.0);
  EXPECT_EQ(rig.out.ego.validity, Validity::kGood);
  EXPECT_LT(rig.position_error_m(), 0.1);
}

TEST(Localization, LosingTheImuIsNotGood) {
  Rig rig = rig_on(Course{});
  rig.run(3.0);
  for (int i = 0; i < 100; ++i) {
    rig.ms += 10;
    world::SensorInput in = rig.arrivals();
    in.imu.clear();
    rig.out =
        step(rig.params, rig.datum, rig.state, in, rig.signals, 0.0, Instant{rig.ms * 1'000'000});
    rig.state = rig.out.next;
  }
  EXPECT_EQ(rig.out.ego.validity, Validity::kDeadReckoning);
}

// One sample, spoilt in one way, into a filter that runs.
Gate gate_of(const Rig& rig, const world::SensorInput& in) {
  const Output out = step(rig.params, rig.datum, rig.state, in, {}, rig.course.bank_rad,
                          Instant{rig.ms * 1'000'000});
  EXPECT_EQ(out.verdicts.size(), 1u);
  return out.verdicts[0].gate;
}

// The steering angle that holds the turn in steady state, worked out on its own.
TEST(Localization, WithoutAnyImuTheCarTurnsAsItsSteeringSays) {
  Rig rig = rig_on(banked_turn());
  rig.run(5.0);
  const world::EgoState truth = rig.truth();
  const double angle_rad = rig.params.wheelbase_m * truth.yaw_rate_rad_per_s / truth.vx_mps +
                           rig.params.understeer_rad_per_mps2 * truth.ay_mps2;
  for (int i = 0; i < 100; ++i) {
    rig.ms += 10;
    world::SensorInput in = rig.arrivals();
    in.imu.clear();
    const Instant now{rig.ms * 1'000'000};
    rig.signals.wheel_speed_mps.at = now;
    rig.signals.steering_motor_rad = {
        .value = angle_rad * rig.params.steering_ratio, .at = now, .heard = true};
    rig.out = step(rig.params, rig.datum, rig.state, in, rig.signals, rig.course.bank_rad, now);
    rig.state = rig.out.next;
    ASSERT_NEAR(rig.out.ego.yaw_rate_rad_per_s, truth.yaw_rate_rad_per_s, 0.01) << i;
    ASSERT_LT(rig.position_error_m(), 0.15) << i;
  }
  // The wheel is straightened: the belief straightens too, instead of holding the last rate.
  rig.signals.steering_motor_rad.value = 0.0;
  rig.signals.steering_motor_rad.at = rig.signals.wheel_speed_mps.at =
      Instant{(rig.ms += 10) * 1'000'000};
  const Output straight = step(rig.params, rig.datum, rig.state, {}, rig.signals,
                               rig.course.bank_rad, Instant{rig.ms * 1'000'000});
  EXPECT_LT(straight.ego.yaw_rate_rad_per_s, 0.5 * truth.yaw_rate_rad_per_s);
}

TEST(Localization, EveryRefusalHasItsReason) {
  Rig rig = rig_on(Course{});
  rig.run(3.0);
  const auto position = [&](auto spoil) {
    world::SensorInput in;
    world::GnssPosition p = rig.position(0, rig.ms - 20);
    spoil(p);
    EXPECT_TRUE(in.positions.push(p));
    return gate_of(rig, in);
  };
  using P = world::GnssPosition;
  EXPECT_EQ(position([](P&) {}), Gate::kAccepted);
  EXPECT_EQ(position([](P& p) { p.unit = 2; }), Gate::kUnknownUnit);
  EXPECT_EQ(position([](P& p) { p.at = p.at + seconds(1); }), Gate::kFromTheFuture);
  EXPECT_EQ(position([](P& p) { p.at = p.at - seconds(1); }), Gate::kTooOld);
  EXPECT_EQ(position([](P& p) { p.solution_status = 1; }), Gate::kNotSolved);
  EXPECT_EQ(position([](P& p) { p.position_type = world::kPositionNone; }), Gate::kNotSolved);
  EXPECT_EQ(position([](P& p) { p.latitude_deg = kUnset; }), Gate::kNotFinite);
  EXPECT_EQ(position([](P& p) { p.latitude_deg = 200.0; }), Gate::kNotFinite);
  EXPECT_EQ(position([](P& p) { p.longitude_sigma_m = kUnset; }), Gate::kNotFinite);
  EXPECT_EQ(position([](P& p) { p.latitude_sigma_m = 3.0; }), Gate::kTooUncertain);
  EXPECT_EQ(position([](P& p) { p.latitude_deg += 1e-4; }), Gate::kOutlier);
}

TEST(Localization, RefusesWhatNoCarCanDo) {
  Rig rig = rig_on(Course{});
  rig.run(3.0);
  const auto velocity = [&](double speed_mps, double track_rad) {
    world::SensorInput in;
    EXPECT_TRUE(in.velocities.push({.unit = 0,
                                    .at = rig.out.ego.at,
                                    .solution_status = world::kSolutionComputed,
                                    .velocity_type = world::kPositionNarrowInt,
                                    .horizontal_mps = speed_mps,
                                    .track_over_ground_rad = track_rad}));
    return gate_of(rig, in);
  };
  EXPECT_EQ(velocity(-1.0, 0.0), Gate::kImplausible);
  EXPECT_EQ(velocity(1e300, 0.0), Gate::kImplausible);
  EXPECT_EQ(velocity(10.0, 1e300), Gate::kImplausible);
  const auto imu = [&](double rate_rad_per_s, double force_mps2) {
    world::SensorInput in;
    EXPECT_TRUE(in.imu.push({.unit = 0,
                             .at = rig.out.ego.at,
                             .rate_rad_per_s = {0.0, 0.0, rate_rad_per_s},
                             .specific_force_mps2 = {force_mps2, 0.0, 9.8}}));
    return gate_of(rig, in);
  };
  EXPECT_EQ(imu(1e300, 0.0), Gate::kImplausible);
  EXPECT_EQ(imu(0.0, -1e300), Gate::kImplausible);
}

TEST(Localization, SecondImuStandsBy) {
  Rig rig = rig_on(Course{});
  rig.run(3.0);
  EXPECT_GT(count(rig, Source::kImu, 1, Gate::kStandby), 300u);
  EXPECT_EQ(count(rig, Source::kImu, 0, Gate::kStandby), 0u);
}

TEST(Localization, TakesNothingFromTheHeap) {
  if (!pitwall::testing::kAllocationsCounted) GTEST_SKIP() << "the sanitizer has its own heap";
  Rig rig = rig_on(banked_turn());
  EXPECT_EQ(pitwall::testing::allocations_of([&] { rig.run(3.0); }), 0u);
  EXPECT_EQ(rig.out.ego.validity, Validity::kGood);
}

TEST(Localization, IsAFunctionOfItsArguments) {
  Rig rig = rig_on(banked_turn());
  rig.run(3.0);
  rig.ms += 10;
  const world::SensorInput in = rig.arrivals();
  const auto once = [&] {
    return step(rig.params, rig.datum, rig.state, in, rig.signals, 0.3,
                Instant{rig.ms * 1'000'000});
  };
  const Output a = once(), b = once();
  EXPECT_EQ(a.ego.x_m, b.ego.x_m);
  EXPECT_EQ(a.next.timeline.newest().covariance, b.next.timeline.newest().covariance);
}

}  // namespace
}  // namespace pitwall::localization
