// SPDX-License-Identifier: Apache-2.0
#include "vehicle/guardian/reckoning.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace pitwall::guardian {
namespace {

constexpr double kCircleSpeed_mps = 60.0, kCircleRadius_m = 250.0, kBank_rad = 0.2;
constexpr double kHeadingRate = kCircleSpeed_mps / kCircleRadius_m;
const double kRate = kHeadingRate * std::cos(kBank_rad);  // about body z
const Geodetic kDatum{36.0, -115.0, 600.0};
constexpr Duration kStep = milliseconds(5);

// A car that does not slip, on a banked circle; it begins at the origin and turns left.
struct Circle {
  ReckoningParams params;
  ReckoningState state;
  Instant now{seconds(100).ns};
  double angle_rad = 0.0;

  Circle() {
    params.bicycle.cg_to_rear_m = 0.0;
    params.bicycle.rear_slip_rad_per_mps2 = 0.0;
    for (ReceiverMounting& unit : params.units) unit = {};
  }
  double x_m() const { return kCircleRadius_m * std::sin(angle_rad); }
  double y_m() const { return kCircleRadius_m * (1.0 - std::cos(angle_rad)); }

  world::SensorInput gyros(double bias0, double bias1) const {
    world::SensorInput in;
    (void)in.imu.push({.unit = 0, .at = now, .rate_rad_per_s = {0, 0, kRate + bias0}});
    (void)in.imu.push({.unit = 1, .at = now, .rate_rad_per_s = {0, 0, kRate + bias1}});
    return in;
  }
  // The inverse of the plane's law near the datum, to a centimetre within 500 m.
  world::GnssPosition position(double dx_m = 0.0, double dy_m = 0.0) const {
    Geodetic g = kDatum;
    for (int i = 0; i < 5; ++i) {
      const PlanePoint at = to_plane(kDatum, g);
      g.longitude_deg += to_deg((x_m() + dx_m - at.x_m) / 5.16e6);
      g.latitude_deg += to_deg((y_m() + dy_m - at.y_m) / 6.36e6);
    }
    return {.unit = 0,
            .at = now,
            .solution_status = world::kSolutionComputed,
            .position_type = world::kPositionNarrowInt,
            .latitude_deg = g.latitude_deg,
            .longitude_deg = g.longitude_deg,
            .height_m = g.height_m,
            .latitude_sigma_m = 0.01,
            .longitude_sigma_m = 0.01};
  }
  void with_car(double bias0, double bias1, int ticks) {
    for (int i = 0; i < ticks; ++i) {
      step();
      store_gyro_rates(state, gyros(bias0, bias1));
      follow_car(params, state,
                 {.at = now,
                  .validity = world::Validity::kGood,
                  .x_m = x_m(),
                  .y_m = y_m(),
                  .yaw_rad = wrap_pi(angle_rad),
                  .vx_mps = kCircleSpeed_mps,
                  .vy_mps = 0.0,
                  .yaw_rate_rad_per_s = kRate});
    }
  }
  void step() {
    now += kStep;
    angle_rad += kHeadingRate * kStep.seconds();
  }
  void alone(const world::SensorInput& in, double motor_rad = kUnset) {
    store_gyro_rates(state, in);
    reckon(params, state, {.speed_mps = kCircleSpeed_mps, .steering_motor_rad = motor_rad}, in,
           kDatum, kBank_rad, now);
  }
  double error_m() const { return std::hypot(state.pose.x_m - x_m(), state.pose.y_m - y_m()); }
};

TEST(Reckoning, GyroscopeAndWheelsAloneKeepACircleForTwentySeconds) {
  Circle c;
  c.with_car(0.0, 0.0, 100);
  for (int i = 0; i < 4000; ++i) {
    c.step();
    c.alone(c.gyros(0.0, 0.0));
  }
  EXPECT_TRUE(c.state.gyro_used);
  EXPECT_LT(c.error_m(), 0.05) << "1.2 km of a perfect gyroscope";
}

TEST(Reckoning, TheBiasOfEachGyroscopeIsLearnedFromTheCar) {
  Circle c;
  c.with_car(0.01, -0.02, 2000);
  EXPECT_NEAR(c.state.gyros[0].bias_rad_per_s, 0.01, 1e-6);
  EXPECT_NEAR(c.state.gyros[1].bias_rad_per_s, -0.02, 1e-6);
  for (int i = 0; i < 2000; ++i) {
    c.step();
    world::SensorInput in = c.gyros(0.01, -0.02);
    in.imu.clear();
    (void)in.imu.push({.unit = 1, .at = c.now, .rate_rad_per_s = {0, 0, kRate - 0.02}});
    c.alone(in);  // the first one has died
  }
  EXPECT_LT(c.error_m(), 0.1);
}

TEST(Reckoning, OfTwoGyroscopesThatDifferTheOneCountsThatTheSteeringAgreesWith) {
  for (const bool first_lies : {true, false}) {
    Circle c;
    c.with_car(0.0, 0.0, 100);
    const double fall = kGravity_mps2 * std::sin(kBank_rad);
    const double k = c.params.bicycle.understeer_rad_per_mps2;
    const double road_rad = c.params.bicycle.wheelbase_m * kRate / kCircleSpeed_mps +
                            k * (kCircleSpeed_mps * kRate - fall);
    for (int i = 0; i < 400; ++i) {
      c.step();
      c.alone(c.gyros(first_lies ? 0.3 : 0.0, first_lies ? 0.0 : 0.3),
              road_rad * c.params.steering_ratio);
    }
    EXPECT_LT(c.error_m(), 0.5) << first_lies;
  }
}

TEST(Reckoning, WithoutAGyroscopeTheSteeringSaysHowItTurns) {
  Circle c;
  c.with_car(0.0, 0.0, 100);
  const double fall = kGravity_mps2 * std::sin(kBank_rad);
  const double road_rad =
      c.params.bicycle.wheelbase_m * kRate / kCircleSpeed_mps +
      c.params.bicycle.understeer_rad_per_mps2 * (kCircleSpeed_mps * kRate - fall);
  for (int i = 0; i < 1000; ++i) {
    c.step();
    c.alone({}, road_rad * c.params.steering_ratio);
  }
  EXPECT_FALSE(c.state.gyro_used);
  EXPECT_LT(c.error_m(), 0.5);
}

TEST(Reckoning, PositionsPullItBackAndTurnItRight) {
  Circle c;
  c.with_car(0.0, 0.0, 100);
  double worst_m = 0.0;
  for (int i = 0; i < 4000; ++i) {
    c.step();
    world::SensorInput in = c.gyros(0.004, 0.004);  // a bias that came later
    if (i % 10 == 0) (void)in.positions.push(c.position());
    c.alone(in);
    worst_m = std::max(worst_m, c.error_m());
  }
  EXPECT_TRUE(c.state.positioned);
  EXPECT_LT(worst_m, 0.6) << "without positions it would be tens of metres";
  EXPECT_EQ(c.state.refused, 0u);
}

TEST(Reckoning, APositionThatJumpsOrIsNotFixedChangesNothing) {
  Circle c;
  c.with_car(0.0, 0.0, 100);
  for (int i = 0; i < 200; ++i) {
    c.step();
    world::SensorInput in = c.gyros(0.0, 0.0);
    if (i % 10 == 0) (void)in.positions.push(c.position(3.0, 0.0));
    world::GnssPosition vague = c.position(0.3, 0.0);
    vague.latitude_sigma_m = 2.0;
    if (i % 10 == 5) (void)in.positions.push(vague);
    c.alone(in);
  }
  EXPECT_EQ(c.state.used, 0u);
  EXPECT_EQ(c.state.refused, 40u);
  EXPECT_FALSE(c.state.positioned);
  EXPECT_LT(c.error_m(), 0.01);
}

TEST(Reckoning, ALatePositionIsTakenForWhereTheCarWasThen) {
  Circle c;
  c.with_car(0.0, 0.0, 100);
  for (int i = 0; i < 200; ++i) {
    const world::GnssPosition then = c.position();
    for (int k = 0; k < 10; ++k) {  // 50 ms, three metres
      c.step();
      world::SensorInput in = c.gyros(0.0, 0.0);
      if (k == 9) (void)in.positions.push(then);
      c.alone(in);
    }
  }
  EXPECT_EQ(c.state.used, 200u);
  EXPECT_LT(c.error_m(), 0.05);
}

TEST(Reckoning, DoesNotBeginWithoutAPlace) {
  Circle c;
  follow_car(c.params, c.state, {});
  EXPECT_FALSE(c.state.begun);
  follow_car(c.params, c.state, {.at = c.now, .validity = world::Validity::kGood});
  EXPECT_FALSE(c.state.begun) << "good, but nowhere";
}

}  // namespace
}  // namespace pitwall::guardian
