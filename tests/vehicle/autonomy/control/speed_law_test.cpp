// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/control/speed_law.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/vehicle/autonomy/control/single_track.hpp"
#include "vehicle/envelope/throttle.hpp"

namespace pitwall::control {
namespace {

constexpr double kDt_s = 0.01;
const LongitudinalParams kLimits = testing::recommended().longitudinal;

SpeedLawParams law() {
  SpeedLawParams p = testing::recommended().speed;
  p.car.engine = envelope::testing::av21_engine();
  return p;
}

SpeedInputs at(double speed_mps, double reference_mps, double planned_mps2 = 0.0) {
  const std::uint8_t gear = speed_mps > 33.0 ? 3 : 2;
  return {.reference_mps = reference_mps,
          .planned_mps2 = planned_mps2,
          .motion = {.speed_mps = speed_mps, .gear = gear},
          .tyre_c = 85.0,
          .applied = {}};
}

// A car that does what its file says, but for `engine` and `brake` of what it should give.
struct FileCar {
  SpeedLawParams file = law();
  double engine = 1.0, brake = 1.0;
  double speed_mps = 40.0;
  LongitudinalState pedals;
  SpeedLawState state;

  SpeedOutput move(double reference_mps, double planned_mps2 = 0.0) {
    SpeedInputs in = at(speed_mps, reference_mps, planned_mps2);
    in.motion.gear = 3;
    in.applied = pedals;
    const SpeedOutput out = step(file, kLimits, state, in, from_seconds(kDt_s));
    pedals = out.next;
    const DrivetrainParams d{file.car, file.brake_kpa_per_mps2, file.rolling_mps2,
                             file.dead_zone_mps2};
    const double torque =
        envelope::torque_nm(file.car.engine, envelope::engine_rpm(file.car.engine, 3, speed_mps),
                            pedals.throttle_fraction);
    const double drive_mps2 = engine * torque * envelope::mps2_per_nm(file.car.engine, 3);
    speed_mps += kDt_s * (drive_mps2 - resistance_mps2(d, in.motion) -
                          brake * pedals.brake_kpa / file.brake_kpa_per_mps2);
    return out;
  }
};

TEST(SpeedLaw, FollowsARampByFeedForwardAlone) {
  FileCar car;
  car.file.kp_per_s = 1e-9, car.file.ki_per_s2 = 0.0;
  for (int i = 0; i < 100; ++i) car.move(40.0);  // the throttle comes from zero
  const double from_mps = car.speed_mps;
  for (int i = 0; i < 200; ++i) car.move(from_mps, 2.0);
  EXPECT_NEAR(car.speed_mps - from_mps, 4.0, 0.2);  // less what the rate of the throttle costs
}

TEST(SpeedLaw, TheIntegralTakesAwayWhatTheModelDoesNotKnow) {
  for (const double engine : {0.8, 1.25}) {
    FileCar car;
    car.engine = engine;
    for (int i = 0; i < 3000; ++i) car.move(40.0);
    EXPECT_NEAR(car.speed_mps, 40.0, 0.01) << engine;
    EXPECT_GT(std::abs(car.state.integral_mps2), 0.05) << engine;
  }
}

TEST(SpeedLaw, TheIntegralStandsStillWhereItCouldNotHelp) {
  FileCar car;
  for (int i = 0; i < 300; ++i) car.move(42.0 + 0.08 * i, 8.0);  // more than full throttle gives
  EXPECT_EQ(car.pedals.throttle_fraction, kLimits.throttle_max);
  EXPECT_EQ(car.state.integral_mps2, 0.0);
  const auto held = [](auto change) {
    SpeedLawState state{.integral_mps2 = 0.3, .braking = false};
    SpeedInputs in = at(40.0, 40.2);
    in.applied = {0.47, 0.0};
    change(in);
    (void)step(law(), kLimits, state, in, from_seconds(kDt_s));
    return state.integral_mps2;
  };
  EXPECT_EQ(held([](SpeedInputs& in) { in.shifting = true; }), 0.3);
  EXPECT_EQ(held([](SpeedInputs& in) { in.changed = true; }), 0.3);
  EXPECT_EQ(held([](SpeedInputs& in) { in.drives = false; }), 0.0);
  EXPECT_EQ(held([](SpeedInputs& in) { in.reference_mps = kUnset; }), 0.0);
}

TEST(SpeedLaw, ContinuesFromWhatWasAppliedAtItsRates) {
  SpeedLawState state;
  SpeedInputs in = at(20.0, 40.0, 2.0);
  in.applied = {0.1, 0.0};
  const SpeedOutput out = step(law(), kLimits, state, in, from_seconds(kDt_s));
  EXPECT_NEAR(out.next.throttle_fraction, 0.1 + kLimits.throttle_rise_per_s * kDt_s, 1e-12);
  in.applied = {0.0, 1500.0};  // as at standstill
  const SpeedOutput released = step(law(), kLimits, state, in, from_seconds(kDt_s));
  EXPECT_EQ(released.next.throttle_fraction, 0.0);
  EXPECT_NEAR(released.next.brake_kpa, 1500.0 - kLimits.brake_fall_kpa_per_s * kDt_s, 1e-9);
}

TEST(SpeedLaw, NeitherPedalRisesBeforeTheOtherIsGone) {
  FileCar car;
  for (int i = 0; i < 3000; ++i) {
    const double wave_mps = 3.0 * std::sin(0.01 * i);
    car.move(40.0 + wave_mps, 3.0 * std::cos(0.01 * i));
    EXPECT_TRUE(car.pedals.throttle_fraction == 0.0 || car.pedals.brake_kpa == 0.0) << i;
  }
}

TEST(SpeedLaw, TheTyresLeaveLessInACornerAndWhenTheyAreCold) {
  const auto hardest = [](double yaw_rate_rad_per_s, double tyre_c) {
    SpeedLawState state;
    SpeedInputs in = at(40.0, 20.0, -8.0);
    in.yaw_rate_rad_per_s = yaw_rate_rad_per_s;
    in.tyre_c = tyre_c;
    return step(law(), kLimits, state, in, from_seconds(kDt_s)).seen;
  };
  const SpeedDiagnostics straight = hardest(0.0, 85.0), corner = hardest(0.25, 85.0);
  EXPECT_TRUE(straight.grip_limited);
  EXPECT_LT(straight.wanted_mps2, corner.wanted_mps2 - 1.0);
  EXPECT_LT(straight.wanted_mps2, hardest(0.0, 30.0).wanted_mps2 - 1.0);
  // By hand: on a flat road the ellipse of 0.9 of the grip beside v times the yaw rate; the front
  // axle, which the brakes load most, may have less.
  const SpeedLawParams p = law();
  const double load = kGravity_mps2 + p.car.downforce_per_m * 1600.0;
  const double grip = 0.9 * p.car.friction * load, lateral = 40.0 * 0.25;
  const double resistance = p.car.drag_per_m * 1600.0 + p.rolling_mps2;
  EXPECT_GE(corner.wanted_mps2, -std::sqrt(grip * grip - lateral * lateral) - resistance - 1e-9);
  const SpeedDiagnostics beyond = hardest(0.5, 85.0);  // the corner uses it all
  EXPECT_NEAR(beyond.wanted_mps2, -resistance, 1e-9);
}

TEST(SpeedLaw, InEverydayDrivingTheTyresDoNotLimit) {
  SpeedLawState state;
  SpeedInputs in = at(40.0, 40.2, 2.5);
  in.yaw_rate_rad_per_s = 0.15;
  EXPECT_FALSE(step(law(), kLimits, state, in, from_seconds(kDt_s)).seen.grip_limited);
}

TEST(SpeedLaw, AShiftHoldsTheThrottle) {
  SpeedLawState state;
  SpeedInputs in = at(34.0, 36.0, 2.5);
  in.applied = {0.45, 0.0};
  in.shifting = true;
  EXPECT_EQ(step(law(), kLimits, state, in, from_seconds(kDt_s)).next.throttle_fraction, 0.45);
  in.planned_mps2 = -8.0;  // who must brake does
  in.applied = {0.0, 0.0};
  EXPECT_GT(step(law(), kLimits, state, in, from_seconds(kDt_s)).next.brake_kpa, 0.0);
}

TEST(SpeedLaw, TheFeedForwardIsThatOfTheGearThatIsEngaged) {
  const auto throttle_in = [](std::uint8_t gear) {
    SpeedLawState state;
    SpeedInputs in = at(34.0, 34.0, 1.5);
    in.motion.gear = gear;
    return step(law(), kLimits, state, in, seconds(10)).next.throttle_fraction;
  };
  EXPECT_NE(throttle_in(2), throttle_in(3));
  EXPECT_GT(throttle_in(3), 0.3);
  EXPECT_EQ(throttle_in(0), 0.0) << "neutral";
}

TEST(SpeedLaw, HoldsTheBrakeAtStandstillAndReleasesWithoutAReference) {
  SpeedLawState state{.integral_mps2 = 0.5, .braking = false};
  SpeedInputs in = at(0.2, 0.0);
  const SpeedOutput standing = step(law(), kLimits, state, in, seconds(1));
  EXPECT_EQ(standing.next.brake_kpa, kLimits.hold_brake_kpa);
  EXPECT_EQ(state.integral_mps2, 0.0);
  in = at(30.0, kUnset);
  in.applied = {0.5, 0.0};
  const SpeedOutput lost = step(law(), kLimits, state, in, from_seconds(kDt_s));
  EXPECT_NEAR(lost.next.throttle_fraction, 0.5 - kLimits.throttle_fall_per_s * kDt_s, 1e-12);
  EXPECT_EQ(lost.next.brake_kpa, 0.0);
}

}  // namespace
}  // namespace pitwall::control
