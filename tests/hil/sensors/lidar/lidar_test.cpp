// SPDX-License-Identifier: Apache-2.0
#include "hil/sensors/lidar/lidar.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

#include "hil/sensors/detection_params.hpp"

namespace pitwall::sensors {
namespace {

constexpr double kWallAhead_m = 30.0;

// An upright wall across the x axis, of one reflectance.
Mesh wall_at(double x_m, float reflectance) {
  const auto x = static_cast<float>(x_m);
  Mesh wall{.reflectance = reflectance};
  wall.add_quad({Corner{x, -400.0F, -200.0F},
                 {x, 400.0F, -200.0F},
                 {x, 400.0F, 200.0F},
                 {x, -400.0F, 200.0F}});
  return wall;
}

LidarUnit exact() {
  LidarUnit unit;
  unit.errors = {.range_sigma_m = 0.0, .lost_share = 0.0, .signal_sigma = 0.0};
  return unit;
}

std::vector<LidarReturn> sweep_of(const LidarUnit& unit, const Mesh& still,
                                  const BodyMotion& ours = {}, std::span<const DustCloud> dust = {},
                                  std::uint64_t seed = 1) {
  RayScene scene{{&still, 1}};
  Noise noise{seed, 0};
  return lidar_sweep(unit, scene, {ours, {}, dust}, noise);
}

double range_m(const LidarReturn& back) { return std::hypot(back.x_m, back.y_m, back.z_m); }

TEST(Lidar, LooksInItsPattern) {
  const auto returns = sweep_of(exact(), wall_at(kWallAhead_m, 0.5F));
  std::set<int> rings;
  float before_s = 0.0F;
  for (const LidarReturn& back : returns) {
    EXPECT_NEAR(back.x_m, kWallAhead_m, 1e-3);
    const double up_rad = std::atan2(back.z_m, std::hypot(back.x_m, back.y_m));
    const double ring = (from_deg(7.9) - up_rad) / from_deg(0.54);
    EXPECT_NEAR(ring, std::round(ring), 1e-3);
    EXPECT_NEAR(back.after_s, std::round(ring) * 0.84e-3, 1e-7) << "top to bottom";
    EXPECT_GE(back.after_s, before_s);
    EXPECT_LE(std::abs(std::atan2(back.y_m, back.x_m)), from_deg(60.0) + 1e-6);
    before_s = back.after_s;
    rings.insert(static_cast<int>(std::round(ring)));
  }
  EXPECT_EQ(rings.size(), 60U);
  EXPECT_EQ(returns.size(), 60U * 858U) << "120 deg in steps of 0.14 deg";
}

TEST(Lidar, AReturnIsWhereTheSensorWasAtItsTime) {
  // Towards the wall at 50 m/s: the last ring is met 2.5 m nearer than the first.
  const BodyMotion ours{.at_m = {0.0, 0.0, 0.0}, .attitude = {}, .velocity_mps = {50.0, 0.0, 0.0}};
  for (const LidarReturn& back : sweep_of(exact(), wall_at(kWallAhead_m, 0.5F), ours))
    EXPECT_NEAR(back.x_m, kWallAhead_m - 50.0 * static_cast<double>(back.after_s), 1e-3);
}

TEST(Lidar, IsMountedWhereTheUnitSays) {
  LidarUnit unit = exact();
  unit.mount = {{1.0, 2.0, 3.0}, {.yaw_rad = from_deg(20.0)}};
  for (const LidarReturn& back : sweep_of(unit, wall_at(kWallAhead_m, 0.5F)))
    EXPECT_NEAR(1.0 + back.x_m * std::cos(from_deg(20.0)) - back.y_m * std::sin(from_deg(20.0)),
                kWallAhead_m, 1e-3);
}

TEST(Lidar, SeesTenPercentAsFarAsItsReach) {
  LidarUnit unit = exact();
  unit.pattern = {.rings = 1, .top_rad = 0.0, .half_width_rad = from_deg(1.0)};
  unit.errors.most_m = 400.0;
  EXPECT_FALSE(sweep_of(unit, wall_at(249.0, 0.1F)).empty());
  EXPECT_TRUE(sweep_of(unit, wall_at(251.0, 0.1F)).empty());
  EXPECT_FALSE(sweep_of(unit, wall_at(251.0, 0.2F)).empty()) << "what is brighter, further";
}

TEST(Lidar, RangesHaveTheirNoiseAndRaysAreLost) {
  LidarUnit unit = exact();
  unit.errors.range_sigma_m = 0.05, unit.errors.lost_share = 0.1;
  const auto returns = sweep_of(unit, wall_at(kWallAhead_m, 0.5F));
  EXPECT_NEAR(static_cast<double>(returns.size()) / (60.0 * 858.0), 0.9, 0.005);
  double squares = 0.0;
  for (const LidarReturn& back : returns) {
    const double error_m = range_m(back) * (1.0 - kWallAhead_m / static_cast<double>(back.x_m));
    squares += error_m * error_m;
  }
  EXPECT_NEAR(std::sqrt(squares / static_cast<double>(returns.size())), 0.05, 0.001);
}

TEST(Lidar, DustSendsBackByItsOpticalDepth) {
  LidarUnit unit = exact();
  unit.pattern = {.rings = 1,
                  .top_rad = 0.0,
                  .half_width_rad = from_deg(0.05),
                  .ray_step_rad = from_deg(0.0001)};
  const DustCloud cloud{{15.0, 0.0, 0.0}, 1.0, 0.2};
  const auto returns = sweep_of(unit, wall_at(kWallAhead_m, 0.5F), {}, {&cloud, 1});
  double from_dust = 0.0, mean_m = 0.0, squares = 0.0;
  for (const LidarReturn& back : returns) {
    if (back.x_m > 25.0F) continue;
    from_dust += 1.0, mean_m += range_m(back);
    squares += (range_m(back) - 15.0) * (range_m(back) - 15.0);
  }
  const double depth = 0.2 * std::sqrt(2.0 * std::numbers::pi);
  EXPECT_NEAR(from_dust / static_cast<double>(returns.size()), 1.0 - std::exp(-depth), 0.04);
  EXPECT_NEAR(mean_m / from_dust, 15.0, 0.15);
  EXPECT_NEAR(std::sqrt(squares / from_dust), 1.0, 0.12);
}

TEST(Lidar, SaysWhichCarSentTheLightBack) {
  const Mesh far = wall_at(100.0, 0.5F);
  RayScene scene{{&far, 1}};
  const Mesh board = wall_at(0.0, 0.5F);
  scene.add_car({&board, 1});
  const BodyMotion car{.at_m = {20.0, 0.0, 0.0}, .attitude = {}, .velocity_mps = {-10.0, 0.0, 0.0}};
  Noise noise{1, 0};
  for (const LidarReturn& back : lidar_sweep(exact(), scene, {{}, {&car, 1}, {}}, noise)) {
    EXPECT_EQ(back.car, 0);
    EXPECT_NEAR(back.x_m, 20.0 - 10.0 * static_cast<double>(back.after_s), 1e-3);
  }
}

TEST(Lidar, TheSameSeedGivesTheSameSweep) {
  const Mesh wall = wall_at(kWallAhead_m, 0.3F);
  const auto first = sweep_of({}, wall), again = sweep_of({}, wall);
  const auto other = sweep_of({}, wall, {}, {}, 2);
  ASSERT_EQ(first.size(), again.size());
  for (std::size_t i = 0; i < first.size(); ++i) ASSERT_EQ(first[i].x_m, again[i].x_m);
  EXPECT_NE(first.size(), other.size());
}

TEST(Lidar, ThreeOfTheAv21LookAllAround) {
  const auto units = av21_lidars();
  ASSERT_EQ(units.size(), 3U);
  double covered_rad = 0.0;
  for (const LidarUnit& unit : units) covered_rad += 2.0 * unit.pattern.half_width_rad;
  EXPECT_NEAR(covered_rad, 2.0 * std::numbers::pi, 1e-9);
}

TEST(Lidar, TheThreeLookWhereTheModelOfTheDetectorHasThem) {
  const std::vector<LidarUnit> units = av21_lidars();
  ASSERT_EQ(units.size(), kLidarUnits);
  for (std::size_t unit = 0; unit < units.size(); ++unit) {
    const double facing_rad = units[unit].mount.attitude.yaw_rad;
    const double half_rad = units[unit].pattern.half_width_rad;
    EXPECT_NEAR(wrap_pi(lidar_sector(unit).from_rad - (facing_rad - half_rad)), 0.0, 1e-12);
    EXPECT_NEAR(wrap_pi(lidar_sector(unit).to_rad - (facing_rad + half_rad)), 0.0, 1e-12);
  }
}

}  // namespace
}  // namespace pitwall::sensors
