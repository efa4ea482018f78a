// SPDX-License-Identifier: Apache-2.0
#include "hil/sensors/camera/shading.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "hil/sensors/lidar/car_mesh.hpp"
#include "hil/sensors/lidar/track_mesh.hpp"

namespace pitwall::sensors {
namespace {

float sum(const Colour& colour) { return colour[0] + colour[1] + colour[2]; }

Meeting of_road(const Vector3& normal) {
  return {.range_m = 20.0, .mesh = static_cast<std::size_t>(TrackMesh::kRoad), .normal = normal};
}

TEST(Shading, ValueNoiseIsSmoothAndBounded) {
  double mean = 0.0;
  for (int i = 0; i < 2'000; ++i) {
    const Vector3 at{0.37 * i, -0.11 * i, 0.05 * i};
    const float here = value_noise(at, 7);
    EXPECT_LE(std::abs(here), 1.0F);
    EXPECT_NEAR(value_noise(plus(at, {0.001, 0.001, 0.001}), 7), here, 0.02);
    mean += here / 2'000;
  }
  EXPECT_NEAR(mean, 0.0, 0.1);
  EXPECT_NE(value_noise({0.5, 0.5, 0.5}, 7), value_noise({0.5, 0.5, 0.5}, 8));
}

// Lambert: the light of a surface falls with the cosine of the sun's angle.
TEST(Shading, ASurfaceTurnedAwayFromTheSunHasOnlyTheSkysLight) {
  Look look = daylight();
  look.light.towards_sun = {0.0, 0.0, 1.0}, look.rough = 0.0;
  const Shading shading{look, {}};
  const Colour lit = shading.surface(of_road({0.0, 0.0, 1.0}), {}, false);
  const Colour shadow = shading.surface(of_road({0.0, 0.0, 1.0}), {}, true);
  const Colour upright = shading.surface(of_road({1.0, 0.0, 0.0}), {}, false);
  EXPECT_GT(sum(lit), 2.0F * sum(shadow));
  EXPECT_NEAR(lit[0], look.road[0] * (look.light.sky[0] + look.light.sun[0]), 1e-6);
  EXPECT_NEAR(shadow[0], look.road[0] * look.light.sky[0], 1e-6);
  EXPECT_LT(sum(upright), sum(shadow) + 1e-6F);
}

TEST(Shading, ACarHasItsPaintOnBothSidesOfItsPlane) {
  Look look = daylight();
  look.paints = {{.first = {1, 0, 0}, .second = {0, 0, 1}, .across = {1, 0, 0}, .apart_m = 0.5}};
  // Turned by half a turn: what lies ahead of it in Map is its rear.
  const std::vector<BodyMotion> cars{
      {.at_m = {100.0, 50.0, 0.0}, .attitude = {.yaw_rad = std::numbers::pi}}};
  const Shading shading{look, cars};
  const Meeting met{.range_m = 10.0, .car = 0, .normal = {0.0, 0.0, 1.0}};
  const Colour rear = shading.surface(met, {102.0, 50.0, 0.5}, false);
  const Colour front = shading.surface(met, {98.0, 50.0, 0.5}, false);
  EXPECT_GT(rear[0], 0.1F);
  EXPECT_EQ(rear[2], 0.0F);
  EXPECT_GT(front[2], 0.1F);
  EXPECT_EQ(front[0], 0.0F);
  const Meeting tyre{.range_m = 10.0,
                     .car = 0,
                     .mesh = static_cast<std::size_t>(CarMesh::kTyres),
                     .normal = {0.0, 0.0, 1.0}};
  EXPECT_LT(sum(shading.surface(tyre, {98.0, 50.0, 0.5}, false)), 0.2F);
}

TEST(Shading, HazeAndDustTakeThingsAwayWithTheDistance) {
  Look look = daylight();
  look.light.haze_per_m = 0.01F;
  const Shading shading{look, {}};
  const Colour black{};
  EXPECT_NEAR(shading.through_haze(black, 100.0)[0],
              look.light.horizon[0] * (1.0F - std::exp(-1.0F)), 1e-6);
  EXPECT_EQ(shading.through_haze(black, 0.0), black);
  const std::vector<DustCloud> dust{{{50.0, 0.0, 0.0}, 2.0, 0.1}};
  const double through = std::exp(-0.1 * 2.0 * std::sqrt(2.0 * std::numbers::pi));
  EXPECT_NEAR(through_dust(dust, {}, {1.0, 0.0, 0.0}, 100.0), through, 1e-12);
  EXPECT_EQ(through_dust(dust, {}, {1.0, 0.0, 0.0}, 40.0), 1.0) << "it lies behind";
  EXPECT_EQ(through_dust(dust, {}, {-1.0, 0.0, 0.0}, 100.0), 1.0);
  EXPECT_GT(through_dust(dust, {0.0, 3.0, 0.0}, {1.0, 0.0, 0.0}, 100.0), through);
}

TEST(Shading, TheSkylineIsDarkerThanTheSkyAndTheSunGlares) {
  Look look = daylight();
  look.light.towards_sun = {0.0, 0.6, 0.8};
  const Shading shading{look, {}};
  EXPECT_LT(sum(shading.sky({1.0, 0.0, -0.1})), sum(shading.sky({0.9, 0.0, 0.43})));
  EXPECT_GT(shading.glare({0.0, 0.6, 0.8}), shading.glare({0.0, 0.8, 0.6}));
  EXPECT_EQ(shading.glare({0.0, -0.6, -0.8}), 0.0F);
}

}  // namespace
}  // namespace pitwall::sensors
