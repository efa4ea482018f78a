// SPDX-License-Identifier: Apache-2.0
#include "tests/hil/plant/single_track.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "hil/plant/plant.hpp"

namespace pitwall::plant {
namespace {

// ---- The published derivatives: CommonRoad vehicle models (TU Munich, BSD-3), test_derivatives,
// for vehicle 2 and the tyre of the Adams handbook, at 0.15 rad/s and 0.63 g.
constexpr double kPublishedGravity_mps2 = 9.81;
constexpr SingleTrackInput kPublishedInput{0.15, 0.63 * kPublishedGravity_mps2};
constexpr double kPublishedFriction = 1.0489;   // p_dy1
constexpr double kPublishedStiffness = -21.92;  // p_ky1
constexpr SingleTrackParams kPublishedParams{
    .front_axle_m = 1.1561957064,
    .rear_axle_m = 1.4227170936,
    .height_m = 0.61373004,
    .mass_kg = 1093.2952334674046,
    .yaw_inertia_kgm2 = 1791.5995300122856,
    .friction = kPublishedFriction,
    .gravity_mps2 = kPublishedGravity_mps2,
    .front_stiffness_per_rad = -kPublishedStiffness / kPublishedFriction,
    .rear_stiffness_per_rad = -kPublishedStiffness / kPublishedFriction,
    .limits = {.angle_min_rad = -1.066,
               .angle_max_rad = 1.066,
               .angle_rate_min_rad_per_s = -0.4,
               .angle_rate_max_rad_per_s = 0.4,
               .speed_min_mps = -13.9,
               .speed_max_mps = 50.8,
               .accel_max_mps2 = 11.5,
               .switching_mps = 7.319}};

void expect_published(double ours, double published, const char* what) {
  EXPECT_NEAR(ours, published, 1e-10 * std::abs(published)) << what;
}

TEST(Published, DerivativesOfTheKinematicModel) {
  const KinematicState d =
      kinematic_derivative(kPublishedParams,
                           {3.9579422297936526, 0.0391650102771405, 0.0378491427211811,
                            16.3546957860883566, 0.0294717351052816},
                           kPublishedInput);
  expect_published(d.x_m, 16.3475935934250209, "x");
  expect_published(d.y_m, 0.4819314886013121, "y");
  expect_published(d.angle_rad, 0.15, "steering angle");
  expect_published(d.speed_mps, 5.1464424102339752, "speed");
  expect_published(d.yaw_rad, 0.2401426578627629, "yaw");
}

TEST(Published, DerivativesOfTheSingleTrackModel) {
  const SingleTrackState s{2.0233348142065677,  0.0041907137716636, 0.0197545248559617,
                           15.7216236334290116, 0.0025857914776859, 0.0529001056654038,
                           0.0033012170610298};
  for (const SingleTrackState& d : {single_track_derivative(kPublishedParams, s, kPublishedInput),
                                    blended_derivative(kPublishedParams, s, kPublishedInput)}) {
    expect_published(d.x_m, 15.7213512030862397, "x");
    expect_published(d.y_m, 0.0925527979719355, "y");
    expect_published(d.angle_rad, 0.15, "steering angle");
    expect_published(d.speed_mps, 5.3536773276413925, "speed");
    expect_published(d.yaw_rad, 0.0529001056654038, "yaw");
    expect_published(d.yaw_rate_rad_per_s, 0.6435589397748606, "yaw rate");
    expect_published(d.slip_rad, 0.0313297971641291, "slip angle");
  }
}

// ---- Limits.
TEST(SingleTrackLimits, BoundWhatIsAsked) {
  const SingleTrackLimits l{.angle_min_rad = -1.0,
                            .angle_max_rad = 1.1,
                            .angle_rate_min_rad_per_s = -0.4,
                            .angle_rate_max_rad_per_s = 0.5,
                            .speed_min_mps = -10.0,
                            .speed_max_mps = 50.0,
                            .accel_max_mps2 = 12.0,
                            .switching_mps = 8.0};
  const auto rate = [&](double asked, double angle) {
    return constrained(l, {asked, 0.0}, angle, 5.0).angle_rate_rad_per_s;
  };
  EXPECT_EQ(rate(9.0, 0.0), 0.5);
  EXPECT_EQ(rate(-9.0, 0.0), -0.4);
  EXPECT_EQ(rate(0.1, 0.0), 0.1);
  EXPECT_EQ(rate(0.1, 1.1), 0.0);  // at the stop only back
  EXPECT_EQ(rate(-0.1, 1.1), -0.1);
  EXPECT_EQ(rate(-0.1, -1.0), 0.0);
  EXPECT_EQ(rate(0.1, -1.2), 0.1);
  const auto accel = [&](double asked, double speed) {
    return constrained(l, {0.0, asked}, 0.0, speed).accel_mps2;
  };
  EXPECT_EQ(accel(99.0, 4.0), 12.0);
  EXPECT_EQ(accel(99.0, 16.0), 6.0);  // constant power above the switching speed
  EXPECT_EQ(accel(-99.0, 16.0), -12.0);
  EXPECT_EQ(accel(3.0, 50.0), 0.0);
  EXPECT_EQ(accel(-3.0, 50.0), -3.0);
  EXPECT_EQ(accel(-3.0, -10.0), 0.0);
}

// ---- Low speed.
std::array<double, 7> entries(const SingleTrackState& s) {
  return {s.x_m, s.y_m, s.angle_rad, s.speed_mps, s.yaw_rad, s.yaw_rate_rad_per_s, s.slip_rad};
}

double apart(const SingleTrackState& a, const SingleTrackState& b) {
  double most = 0.0;
  for (std::size_t i = 0; i < 7; ++i)
    most = std::max(most, std::abs(entries(a)[i] - entries(b)[i]));
  return most;
}

SingleTrackState turning(double speed_mps) {
  return {.angle_rad = 0.12, .speed_mps = speed_mps, .yaw_rate_rad_per_s = 0.1, .slip_rad = -0.01};
}

TEST(SingleTrackBlend, IsThePublishedModelAboveAndKinematicBelow) {
  const SingleTrackParams p = single_track_of(Params{});
  const SingleTrackInput u{0.2, 1.5};
  for (const double v : {kBlendTo_mps, 9.0, 60.0})
    EXPECT_EQ(
        apart(blended_derivative(p, turning(v), u), single_track_derivative(p, turning(v), u)),
        0.0);
  // Below, the centre of gravity goes where a car goes whose wheels do not slip: the rear axle of
  // the kinematic model, put forward by its distance.
  for (const double v : {-2.0, 0.0, 0.5, kBlendFrom_mps}) {
    Params free_params;
    SingleTrackParams q = single_track_of(free_params);
    q.limits.speed_min_mps = -5.0;
    SingleTrackState s{.angle_rad = 0.15, .speed_mps = v, .yaw_rad = 0.3};
    s.slip_rad = std::atan(q.rear_axle_m / (q.front_axle_m + q.rear_axle_m) * std::tan(0.15));
    const double axle_mps = v * std::cos(s.slip_rad);
    const KinematicState axle =
        kinematic_derivative(q, {.angle_rad = 0.15, .speed_mps = axle_mps, .yaw_rad = 0.3}, {});
    s.yaw_rate_rad_per_s = axle.yaw_rad;
    const SingleTrackState d = blended_derivative(q, s, {});
    EXPECT_NEAR(d.yaw_rad, axle.yaw_rad, 1e-12);
    EXPECT_NEAR(d.x_m, axle.x_m - q.rear_axle_m * std::sin(0.3) * axle.yaw_rad, 1e-12);
    EXPECT_NEAR(d.y_m, axle.y_m + q.rear_axle_m * std::cos(0.3) * axle.yaw_rad, 1e-12);
    EXPECT_NEAR(d.yaw_rate_rad_per_s, 0.0, 1e-12);
    EXPECT_NEAR(d.slip_rad, 0.0, 1e-12);
  }
}

TEST(SingleTrackBlend, HasNoStepAndNoKinkInSpeed) {
  const SingleTrackParams p = single_track_of(Params{});
  const SingleTrackInput u{0.2, 1.5};
  const auto at = [&](double v) { return blended_derivative(p, turning(v), u); };
  for (const double v : {kBlendFrom_mps, kBlendTo_mps}) {
    constexpr double kNear = 1e-6;
    EXPECT_LT(apart(at(v - kNear), at(v + kNear)), 1e-3);
    const auto left = entries(at(v - kNear)), mid = entries(at(v)), right = entries(at(v + kNear));
    for (std::size_t i = 0; i < 7; ++i)
      EXPECT_NEAR((right[i] - mid[i]) / kNear, (mid[i] - left[i]) / kNear, 1e-2) << v << " " << i;
  }
}

// Off by any amount, slip angle and yaw rate come to what the steering says.
TEST(SingleTrackBlend, StartsFromRestAndComesToRest) {
  SingleTrackParams p = single_track_of(Params{});
  for (const double step_s : {0.001, 0.010, 0.010}) {
    SingleTrackState s{.angle_rad = 0.1, .yaw_rate_rad_per_s = 2.0, .slip_rad = 0.5};
    double fastest = 0.0;
    for (double t_s = 0.0; t_s < 20.0; t_s += step_s) {
      const double accel = t_s < 8.0 ? 1.5 : s.speed_mps > 0.0 ? -2.0 : 0.0;
      s = blended_step(p, s, {0.0, accel}, step_s);
      for (const double v : entries(s)) ASSERT_TRUE(std::isfinite(v));
      if (t_s > 1.0) {
        ASSERT_LT(std::abs(s.slip_rad), 0.1) << t_s;
        ASSERT_LT(std::abs(s.yaw_rate_rad_per_s), 0.5) << t_s;
      }
      fastest = std::max(fastest, s.speed_mps);
    }
    EXPECT_GT(fastest, 10.0);
    EXPECT_NEAR(s.speed_mps, 0.0, 0.03);
    EXPECT_NEAR(s.yaw_rate_rad_per_s, s.speed_mps * std::tan(0.1) / 2.971, 1e-3);
    if (step_s == 0.010) p.front_stiffness_per_rad *= 2.0, p.rear_stiffness_per_rad *= 2.0;
  }
}

// Neither step size nor blend may decide where the car goes.
TEST(SingleTrackBlend, StepsConvergeWithOrderFour) {
  const SingleTrackParams p = single_track_of(Params{});
  const auto after = [&](int steps) {
    SingleTrackState s{.angle_rad = 0.02, .speed_mps = 20.0};
    for (int i = 0; i < steps; ++i) s = blended_step(p, s, {0.05, 1.0}, 0.4 / steps);
    return s;
  };
  const SingleTrackState exact = after(6400);
  double coarse = apart(after(20), exact);
  for (const int steps : {40, 80, 160}) {
    const double fine = apart(after(steps), exact);
    EXPECT_GE(std::log2(coarse / fine), 3.8);
    coarse = fine;
  }
}

TEST(SingleTrack, LeftAndRightAreMirroredExactly) {
  const SingleTrackParams p = single_track_of(Params{});
  SingleTrackState left{.speed_mps = 0.2}, right = left;
  KinematicState left_kinematic{.speed_mps = 0.2}, right_kinematic = left_kinematic;
  for (int i = 0; i < 2000; ++i) {
    const SingleTrackInput u{0.4 * std::cos(0.003 * i), 4.0};
    const SingleTrackInput mirrored{-u.angle_rate_rad_per_s, u.accel_mps2};
    left = blended_step(p, left, u, 0.005);
    right = blended_step(p, right, mirrored, 0.005);
    left_kinematic = kinematic_step(p, left_kinematic, u, 0.005);
    right_kinematic = kinematic_step(p, right_kinematic, mirrored, 0.005);
    ASSERT_EQ(left.y_m, -right.y_m);
    ASSERT_EQ(left.yaw_rate_rad_per_s, -right.yaw_rate_rad_per_s);
    ASSERT_EQ(left.slip_rad, -right.slip_rad);
    ASSERT_EQ(left.x_m, right.x_m);
    ASSERT_EQ(left_kinematic.y_m, -right_kinematic.y_m);
  }
  EXPECT_GT(std::abs(left.y_m), 1.0);
}

// The double track at small slip angles, where downforce is small beside the weight.
TEST(SingleTrack, TurnsAsTheDoubleTrackDoes) {
  const Params p;
  const SingleTrackParams q = single_track_of(p);
  for (const double speed_mps : {6.0, 12.0, 18.0}) {
    const double motor_rad = 0.35;
    State s = rolling(p, standing(p, 0, 0, 0), speed_mps, 0);
    SingleTrackState track{.angle_rad = std::round(motor_rad / p.steering.quantum_rad) *
                                        p.steering.quantum_rad / p.steering.ratio,
                           .speed_mps = speed_mps};
    for (int i = 0; i < 2500; ++i) {
      s = step(p, s, {.steering_motor_rad = motor_rad}, {}, 0.001);
      track.speed_mps = s.motion.vx_mps;
      track = blended_step(q, track, {}, 0.001);
    }
    EXPECT_NEAR(track.yaw_rate_rad_per_s / s.motion.yaw_rate_rad_per_s, 1.0, 0.02) << speed_mps;
  }
}

}  // namespace
}  // namespace pitwall::plant
