// SPDX-License-Identifier: Apache-2.0
#include "hil/sensors/lidar/random_scene.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/hil/traffic/oval.hpp"

namespace pitwall::sensors {
namespace {

constexpr std::uint64_t kSeeds = 12;

TEST(RandomScene, ReturnsOfACarLieAboutItsBox) {
  // A ray that is 38 ms from the reference time meets a car that goes 90 m/s 3.4 m from there, less
  // what our own car went: at most 15 m/s apart, and what the turn adds.
  SceneMaker maker{traffic::oval(), {av21_shape()}, {.dust = 0.0}};
  std::size_t cars = 0;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const LidarScene scene = maker.make(seed);
    for (const UnitSweep& sweep : scene.sweeps) {
      const Rotation mount = rotation(sweep.mount.attitude);
      for (const LidarReturn& back : sweep.returns) {
        if (back.car < 0) continue;
        const TrueBox& box = scene.cars[static_cast<std::size_t>(back.car)];
        const Vector3 at = plus(sweep.mount.at_m, turned(mount, {back.x_m, back.y_m, back.z_m}));
        const double dx_m = at[0] - box.x_m, dy_m = at[1] - box.y_m;
        const double along_m = dx_m * std::cos(box.yaw_rad) + dy_m * std::sin(box.yaw_rad);
        const double across_m = dy_m * std::cos(box.yaw_rad) - dx_m * std::sin(box.yaw_rad);
        const double turned_m = 0.02 * std::hypot(box.x_m, box.y_m);
        EXPECT_LT(std::abs(along_m), 0.5 * box.length_m + 0.8 + turned_m) << seed;
        EXPECT_LT(std::abs(across_m), 0.5 * box.width_m + 0.2 + turned_m) << seed;
      }
    }
    for (const TrueBox& box : scene.cars) cars += box.returns > 0;
  }
  EXPECT_GT(cars, kSeeds) << "or the test has seen next to nothing";
}

TEST(RandomScene, NoTwoCarsAreInOnePlace) {
  SceneMaker maker{traffic::oval(), {sf23_shape()}};
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    std::vector<TrueBox> cars = maker.make(seed).cars;
    cars.push_back({.x_m = 0.0, .y_m = 0.0});
    for (std::size_t i = 0; i < cars.size(); ++i)
      for (std::size_t k = 0; k < i; ++k)
        EXPECT_GT(std::hypot(cars[i].x_m - cars[k].x_m, cars[i].y_m - cars[k].y_m), 2.2) << seed;
  }
}

TEST(RandomScene, TheSameSeedGivesTheSameScene) {
  SceneMaker maker{traffic::oval(), {av21_shape()}};
  const LidarScene first = maker.make(5), between = maker.make(6), again = maker.make(5);
  ASSERT_EQ(first.sweeps.size(), 3U);
  EXPECT_EQ(first.x_m, again.x_m);
  EXPECT_NE(first.x_m, between.x_m);
  for (std::size_t k = 0; k < 3; ++k) {
    ASSERT_EQ(first.sweeps[k].returns.size(), again.sweeps[k].returns.size());
    for (std::size_t i = 0; i < first.sweeps[k].returns.size(); ++i)
      ASSERT_EQ(first.sweeps[k].returns[i].x_m, again.sweeps[k].returns[i].x_m);
  }
}

TEST(RandomScene, DustIsOnlyThereWhereItIsAskedFor) {
  SceneMaker clear{traffic::oval(), {av21_shape()}, {.dust = 0.0}},
      dusty{traffic::oval(), {av21_shape()}, {.dust = 3.0}};
  std::size_t differing = 0;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const LidarScene without = clear.make(seed), with = dusty.make(seed);
    ASSERT_EQ(without.cars.size(), with.cars.size());
    differing += without.sweeps[0].returns.size() != with.sweeps[0].returns.size();
  }
  EXPECT_GT(differing, 2U);
}

}  // namespace
}  // namespace pitwall::sensors
