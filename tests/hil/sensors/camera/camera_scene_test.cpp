// SPDX-License-Identifier: Apache-2.0
#include "hil/sensors/camera/camera_scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/hil/traffic/oval.hpp"

namespace pitwall::sensors {
namespace {

constexpr std::uint64_t kImages = 16;

// What shows a car lies in the box about it, and its height fits its depth.
TEST(CameraScene, TheTruthIsThatOfTheImage) {
  CameraSceneMaker maker{traffic::oval(), {av21_shape()}, {.spun_share = 0.3, .varied = true}};
  std::size_t cars = 0;
  for (std::uint64_t seed = 0; seed < kImages; ++seed) {
    const CameraScene scene = maker.make(seed);
    const auto shown = static_cast<std::size_t>(
        std::ranges::count_if(scene.image.car, [](int c) { return c >= 0; }));
    std::size_t pixels = 0, in_boxes = 0;
    for (const SeenCar& car : scene.cars) {
      pixels += car.pixels;
      EXPECT_NEAR(car.upright_px, scene.unit.optics.focal_y_px * 1.16 / car.depth_m, 1e-9);
      EXPECT_GE(car.height_px, 0.9 * car.upright_px);
      EXPECT_GT(car.x_m, 0.0);
    }
    for (int v = 0; v < scene.image.height_px; ++v)
      for (int u = 0; u < scene.image.width_px; ++u) {
        if (scene.image.car[static_cast<std::size_t>(v * scene.image.width_px + u)] < 0) continue;
        in_boxes += std::ranges::any_of(scene.cars, [&](const SeenCar& car) {
          // The box is about the middle of what it spans, the car's middle near it.
          return std::abs(u - car.u_px) < 0.8 * car.width_px + 2.0 &&
                 std::abs(v - car.v_px) < 0.8 * car.height_px + 2.0;
        });
      }
    EXPECT_GE(100 * in_boxes, 98 * shown) << seed;
    EXPECT_LE(pixels, shown);
    cars += scene.cars.size();
  }
  EXPECT_GT(cars, kImages / 2) << "or the test has seen next to nothing";
}

TEST(CameraScene, TheSameSeedGivesTheSameScene) {
  CameraSceneMaker maker{traffic::oval(), {av21_shape()}, {}};
  const CameraScene first = maker.make(8), other = maker.make(9), again = maker.make(8);
  EXPECT_EQ(first.image.rgb, again.image.rgb);
  EXPECT_NE(first.image.rgb, other.image.rgb);
  EXPECT_EQ(first.cars.size(), again.cars.size());
  EXPECT_NE(first.unit.mount.at_m[1], other.unit.mount.at_m[1]) << "left and right in turn";
}

TEST(CameraScene, DecoysAreShownAndAreNoCars) {
  CameraSceneMaker plain{traffic::oval(), {av21_shape()}, {}},
      among{traffic::oval(), {av21_shape()}, {.decoys = DecoySet::kCommon}};
  std::size_t differing = 0;
  for (std::uint64_t seed = 0; seed < kImages; ++seed) {
    const CameraScene without = plain.make(seed), with = among.make(seed);
    differing += without.image.rgb != with.image.rgb;
    EXPECT_LE(with.cars.size(), without.cars.size()) << "a decoy hides a car at most";
  }
  EXPECT_GT(differing, kImages / 4);
}

TEST(CameraScene, OnlyTheRulesVaryTheCamera) {
  CameraSceneMaker plain{traffic::oval(), {av21_shape()}, {}},
      varied{traffic::oval(), {av21_shape()}, {.varied = true}};
  EXPECT_EQ(plain.make(4).unit.optics.focal_x_px, av21_front_cameras()[0].optics.focal_x_px);
  EXPECT_NE(varied.make(4).unit.optics.focal_x_px, av21_front_cameras()[0].optics.focal_x_px);
}

}  // namespace
}  // namespace pitwall::sensors
