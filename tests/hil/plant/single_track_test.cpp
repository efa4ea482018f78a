// SPDX-License-Identifier: Apache-2.0
#include "hil/plant/single_track.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "hil/plant/plant.hpp"
#include "tests/support/public_data.hpp"

namespace pitwall::plant {
namespace {

// ---- The published derivatives. Their input: 0.15 rad/s and 0.63 g.
constexpr double kPublishedGravity_mps2 = 9.81;
constexpr SingleTrackInput kPublishedInput{0.15, 0.63 * kPublishedGravity_mps2};

// Numbers of a YAML file of two levels, by "section.key" or "key".
std::map<std::string, double> numbers_of(const std::filesystem::path& path) {
  std::map<std::string, double> out;
  std::ifstream file(path);
  std::string section;
  for (std::string line; std::getline(file, line);) {
    const auto colon = line.find(':');
    if (line.empty() || line[0] == '#' || colon == std::string::npos) continue;
    const auto first = line.find_first_not_of(' ');
    if (line[first] == '#') continue;
    const std::string key = line.substr(first, colon - first), value = line.substr(colon + 1);
    if (first == 0) section.clear();
    if (value.find_first_not_of(" \r") == std::string::npos)
      section = key + ".";
    else
      out[section + key] = std::stod(value);
  }
  return out;
}

// Rows by "model x" and "model f".
std::map<std::string, std::vector<double>> published_rows() {
  std::map<std::string, std::vector<double>> rows;
  std::ifstream file(recordings::folder() / "plant/commonroad_ground_truth_derivatives.txt");
  for (std::string line; std::getline(file, line);) {
    std::istringstream fields(line);
    std::string model, kind;
    if (line.empty() || line[0] == '#' || !(fields >> model >> kind)) continue;
    for (double value; fields >> value;) rows[model + " " + kind].push_back(value);
  }
  return rows;
}

SingleTrackParams published_params() {
  auto car = numbers_of(recordings::folder() / "plant/parameters_vehicle2.yaml");
  auto tyre = numbers_of(recordings::folder() / "plant/parameters_tire.yaml");
  // The file names the tyre's coefficients below "tire"; the lateral ones follow a comment.
  const double friction = tyre.at("tire.p_dy1");
  const double stiffness = -tyre.at("tire.p_ky1") / friction;
  return {.front_axle_m = car.at("a"),
          .rear_axle_m = car.at("b"),
          .height_m = car.at("h_s"),
          .mass_kg = car.at("m"),
          .yaw_inertia_kgm2 = car.at("I_z"),
          .friction = friction,
          .gravity_mps2 = kPublishedGravity_mps2,
          .front_stiffness_per_rad = stiffness,
          .rear_stiffness_per_rad = stiffness,
          .limits = {.angle_min_rad = car.at("steering.min"),
                     .angle_max_rad = car.at("steering.max"),
                     .angle_rate_min_rad_per_s = car.at("steering.v_min"),
                     .angle_rate_max_rad_per_s = car.at("steering.v_max"),
                     .speed_min_mps = car.at("longitudinal.v_min"),
                     .speed_max_mps = car.at("longitudinal.v_max"),
                     .accel_max_mps2 = car.at("longitudinal.a_max"),
                     .switching_mps = car.at("longitudinal.v_switch")}};
}

void expect_published(double ours, double published, const char* what) {
  EXPECT_NEAR(ours, published, 1e-10 * std::abs(published)) << what;
}

class Published : public testing::Test {
 protected:
  void SetUp() override {
    rows = published_rows();
    if (rows.empty())
      GTEST_SKIP() << "no published derivatives in " << recordings::folder() / "plant";
  }
  std::map<std::string, std::vector<double>> rows;
};

TEST_F(Published, DerivativesOfTheKinematicModel) {
  const std::vector<double>&x = rows.at("ks x"), &f = rows.at("ks f");
  ASSERT_EQ(x.size(), 5U);
  ASSERT_EQ(f.size(), 5U);
  const KinematicState d =
      kinematic_derivative(published_params(), {x[0], x[1], x[2], x[3], x[4]}, kPublishedInput);
  expect_published(d.x_m, f[0], "x");
  expect_published(d.y_m, f[1], "y");
  expect_published(d.angle_rad, f[2], "steering angle");
  expect_published(d.speed_mps, f[3], "speed");
  expect_published(d.yaw_rad, f[4], "yaw");
}

TEST_F(Published, DerivativesOfTheSingleTrackModel) {
  const std::vector<double>&x = rows.at("st x"), &f = rows.at("st f");
  ASSERT_EQ(x.size(), 7U);
  ASSERT_EQ(f.size(), 7U);
  const SingleTrackState s{x[0], x[1], x[2], x[3], x[4], x[5], x[6]};
  for (const SingleTrackState& d : {single_track_derivative(published_params(), s, kPublishedInput),
                                    blended_derivative(published_params(), s, kPublishedInput)}) {
    expect_published(d.x_m, f[0], "x");
    expect_published(d.y_m, f[1], "y");
    expect_published(d.angle_rad, f[2], "steering angle");
    expect_published(d.speed_mps, f[3], "speed");
    expect_published(d.yaw_rad, f[4], "yaw");
    expect_published(d.yaw_rate_rad_per_s, f[5], "yaw rate");
    expect_published(d.slip_rad, f[6], "slip angle");
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
