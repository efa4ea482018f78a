// The ground as the plant has it: the map's road, and a car on it whose position, attitude, rates
// and forces are one motion. Checked by differences, which know nothing of the formulas.
// SPDX-License-Identifier: Apache-2.0
#include "hil/plant/road_surface.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "hil/plant/dynamics.hpp"
#include "protocol/vocabulary/random.hpp"
#include "tests/hil/plant/step.hpp"

namespace pitwall::plant {
namespace {

constexpr double kHeight_m = 0.28;

world::TrackMap ring(double lowest_rad, double highest_rad) {
  world::TrackDescription d;
  d.name = "ring";
  constexpr double kRadius_m = 200.0;
  d.length_m = 2.0 * std::numbers::pi * kRadius_m;
  d.datum_latitude_deg = 36.0, d.datum_longitude_deg = -115.0, d.datum_height_m = 0.0;
  for (int i = 0; i < 16; ++i)
    d.knots.push_back(
        {i * d.length_m / 16, 1.0 / kRadius_m, i % 4 < 2 ? lowest_rad : highest_rad, 9.0, 9.0});
  auto map = world::TrackMap::build(d);
  if (!map) throw std::runtime_error(to_string(map.error()));
  return *std::move(map);
}

State placed(const world::TrackMap& map, double s_m, double n_m, double error_rad) {
  const auto point = map.offset(s_m, n_m);
  return standing({}, point.x_m, point.y_m, point.yaw_rad + error_rad);
}

TEST(RoadSurface, IsTheMapsRoadWhereTheBankingDoesNotChange) {
  const auto map = ring(0.3, 0.3);
  const RoadSurface ground(map, 0.0, kHeight_m);
  for (const double n_m : {-6.0, 0.0, 3.0}) {
    const State s = placed(map, 300.0, n_m, 0.0);
    const Surface lie = ground.at(road_at({}, map, s), s.motion);
    EXPECT_NEAR(lie.bank_rad, 0.3, 1e-12);
    EXPECT_NEAR(lie.climb_rad, 0.0, 1e-12);
    EXPECT_NEAR(lie.height_m, map.road(300.0, n_m).height_m + kHeight_m / std::cos(0.3), 1e-9);
  }
}

TEST(RoadSurface, StaysNearTheMapWhereTheBankingBends) {
  const auto map = ring(0.1, 0.3);  // over 78 m, as between the turns of Las Vegas
  const RoadSurface ground(map, 0.0, kHeight_m);
  double worst_rad = 0.0, worst_climb_rad = 0.0;
  for (double s_m = 0.0; s_m < map.length_m(); s_m += 0.7) {
    const State s = placed(map, s_m, -5.0, 0.0);
    const Surface lie = ground.at(road_at({}, map, s), s.motion);
    const world::RoadPoint road = map.road(s_m, -5.0);
    worst_rad = std::max(worst_rad, std::abs(lie.bank_rad - road.bank_rad));
    worst_climb_rad = std::max(worst_climb_rad, std::abs(lie.climb_rad - road.climb_rad));
    EXPECT_NEAR(lie.height_m - kHeight_m / std::cos(lie.bank_rad), road.height_m, 0.02);
  }
  EXPECT_LT(worst_rad, from_deg(0.2));
  EXPECT_GT(worst_rad, 0.0);
  EXPECT_LT(worst_climb_rad, from_deg(0.6));
}

TEST(RoadSurface, IsSteeperByTheErrorOfTheMap) {
  const auto map = ring(0.2, 0.2);
  const State s = placed(map, 100.0, 2.0, 0.0);
  const RoadSurface ground(map, 0.03, kHeight_m);
  EXPECT_NEAR(ground.at(road_at({}, map, s), s.motion).bank_rad, 0.23, 1e-12);
}

TEST(RoadSurface, ACarThatPointsUpTheBankClimbs) {
  const auto map = ring(0.2, 0.2);
  const RoadSurface ground(map, 0.0, kHeight_m);
  const State up = placed(map, 100.0, 0.0, -std::numbers::pi / 2.0);  // the left side is lower
  const Surface lie = ground.at(road_at({}, map, up), up.motion);
  EXPECT_NEAR(lie.climb_rad, 0.2, 1e-9);
  EXPECT_NEAR(lie.bank_rad, 0.0, 1e-9);
  // And rolls back: gravity along the car.
  const State rolling_up = rolling({}, up, 20.0, 0);
  const Motion d = derivative_of({}, rolling_up, rolling_up.motion, lie, {});
  const Motion level = derivative_of({}, rolling_up, rolling_up.motion, {}, {});
  EXPECT_NEAR(d.vx_mps - level.vx_mps, -kGravity_mps2 * std::sin(0.2), 0.05);
}

// Rates against the lie of the road a moment before and after, anywhere and however the car moves.
TEST(RoadSurface, RatesAreThoseOfTheLieAlongTheMotion) {
  const auto map = ring(0.05, 0.35);
  const RoadSurface ground(map, 0.0, kHeight_m);
  Random random{7};
  const auto dice = [&](double low, double high) { return low + (high - low) * random.uniform(); };
  constexpr double kHalf_s = 1e-5;
  for (int i = 0; i < 500; ++i) {
    State s = placed(map, dice(0.0, map.length_m()), dice(-6.0, 6.0),
                     dice(-std::numbers::pi, std::numbers::pi));
    s.motion.vx_mps = dice(-10.0, 80.0), s.motion.vy_mps = dice(-10.0, 10.0);
    s.motion.yaw_rate_rad_per_s = dice(-2.0, 2.0);
    const Surface lie = ground.at(road_at({}, map, s), s.motion);
    const Truth t = observe({}, s, lie);
    const auto after = [&](double dt_s) {
      State moved = s;
      moved.motion.x_m += dt_s * t.map_vx_mps, moved.motion.y_m += dt_s * t.map_vy_mps;
      moved.motion.yaw_rad += dt_s * t.heading_rate_rad_per_s;
      return ground.at(road_at({}, map, moved), moved.motion);
    };
    const Surface a = after(-kHalf_s), b = after(kHalf_s);
    const auto rate = [&](double from, double to) { return (to - from) / (2.0 * kHalf_s); };
    EXPECT_NEAR(lie.bank_rate_rad_per_s, rate(a.bank_rad, b.bank_rad), 2e-4);
    EXPECT_NEAR(lie.climb_rate_rad_per_s, rate(a.climb_rad, b.climb_rad), 2e-4);
    EXPECT_NEAR(t.map_vz_mps, rate(a.height_m, b.height_m), 2e-4);
  }
}

// ---- A drive: what is true at one instant against what is true around it.
using Matrix = std::array<std::array<double, 3>, 3>;

Matrix attitude(const Truth& t) {
  const double cr = std::cos(t.roll_rad), sr = std::sin(t.roll_rad);
  const double cp = std::cos(t.pitch_rad), sp = std::sin(t.pitch_rad);
  const double cy = std::cos(t.yaw_rad), sy = std::sin(t.yaw_rad);
  return {{{cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr},
           {sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr},
           {-sp, cp * sr, cp * cr}}};
}

std::array<double, 3> to_body(const Matrix& m, const std::array<double, 3>& v) {
  std::array<double, 3> out{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) out[i] += m[k][i] * v[k];
  return out;
}

// Weaves round the ring at about `speed_mps`.
std::vector<Truth> drive(const world::TrackMap& map, double speed_mps, double duration_s) {
  const Params p;
  const RoadSurface ground(map, 0.0, kHeight_m);
  State s = rolling(p, placed(map, 10.0, 0.0, 0.0), speed_mps, 5);
  Road here = road_at(p, map, s);
  std::vector<Truth> drive;
  for (double t_s = 0.0; t_s < duration_s; t_s += kStep_s) {
    const double wanted_m = 4.0 * std::sin(0.8 * t_s);
    const double wheel_rad = 0.016 - 0.008 * (here.n_m - wanted_m) - 0.25 * here.heading_error_rad;
    const Actuation a{.steering_motor_rad = p.steering.ratio * wheel_rad,
                      .throttle_fraction = 0.3 + 0.2 * (speed_mps - s.motion.vx_mps),
                      .gear = 5,
                      .ignition = true};
    s = step(p, s, a, ground.at(here, s.motion), kStep_s);
    here = road_at(p, map, s, here.s_m);
    drive.push_back(observe(p, s, ground.at(here, s.motion)));
  }
  return drive;
}

TEST(RoadSurface, TheTruthOfADriveIsOneMotion) {
  const auto map = ring(0.05, 0.35);
  const std::vector<Truth> truth = drive(map, 55.0, 20.0);
  double least_m = 1e9, most_m = -1e9, worst_force = 0.0, worst_rate = 0.0, worst_speed = 0.0;
  for (std::size_t i = 1; i + 1 < truth.size(); ++i) {
    const Truth &a = truth[i - 1], &t = truth[i], &b = truth[i + 1];
    const auto rate = [](double from, double to) { return (to - from) / (2.0 * kStep_s); };
    for (const double error : {t.map_vx_mps - rate(a.x_m, b.x_m), t.map_vy_mps - rate(a.y_m, b.y_m),
                               t.map_vz_mps - rate(a.z_m, b.z_m)})
      worst_speed = std::max(worst_speed, std::abs(error));
    const Matrix m = attitude(t), before = attitude(a), after = attitude(b);
    const auto felt =
        to_body(m, {rate(a.map_vx_mps, b.map_vx_mps), rate(a.map_vy_mps, b.map_vy_mps),
                    rate(a.map_vz_mps, b.map_vz_mps) + kGravity_mps2});
    for (std::size_t k = 0; k < 3; ++k)
      worst_force = std::max(worst_force, std::abs(felt[k] - t.specific_force_mps2[k]));
    Matrix turn{};  // m^T m' = the cross-product matrix of the body rates
    for (std::size_t r = 0; r < 3; ++r)
      for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t k = 0; k < 3; ++k) turn[r][c] += m[k][r] * rate(before[k][c], after[k][c]);
    const std::array<double, 3> turned{turn[2][1], turn[0][2], turn[1][0]};
    for (std::size_t k = 0; k < 3; ++k)
      worst_rate = std::max(worst_rate, std::abs(turned[k] - t.rate_rad_per_s[k]));
    least_m = std::min(least_m, t.z_m), most_m = std::max(most_m, t.z_m);
  }
  EXPECT_GT(most_m - least_m, 1.0) << "the drive goes up and down";
  EXPECT_LT(worst_speed, 0.01);
  EXPECT_LT(worst_rate, 0.003);
  EXPECT_LT(worst_force, 0.08);
  std::printf("velocity %.2g m/s, rates %.2g rad/s, specific force %.2g m/s^2\n", worst_speed,
              worst_rate, worst_force);
}

}  // namespace
}  // namespace pitwall::plant
