// SPDX-License-Identifier: Apache-2.0
#include "hil/sensors/camera/camera.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "hil/sensors/lidar/body_motion.hpp"
#include "hil/sensors/lidar/car_mesh.hpp"
#include "hil/sensors/lidar/drawn_cars.hpp"
#include "tests/hil/traffic/oval_cars.hpp"

namespace pitwall::sensors {
namespace {

constexpr double kOurs_m = 100.0;  // on the straight

BodyMotion ours() {
  return motion_on_road(traffic::oval(), traffic::pose_on_oval(kOurs_m, 0.0, 60.0),
                        kOriginOverRoad_m);
}

// A camera that looks straight ahead.
CameraUnit ahead() {
  CameraUnit unit = av21_front_cameras()[0];
  unit.mount = {{0.6, 0.0, 0.7}, {}};
  return unit;
}

struct Shown {
  CameraImage image;
  std::vector<BodyMotion> cars;
};

Shown show(const CameraUnit& unit, const std::vector<plant::CarPose>& others, const Look& look,
           std::uint64_t seed = 1) {
  RayScene scene{track_scene_meshes(traffic::oval())};
  Shown shown;
  for (const plant::CarPose& other : others) {
    const std::size_t car = scene.add_car(car_meshes(av21_shape()));
    shown.cars.push_back(motion_on_road(traffic::oval(), other));
    scene.place(car, rotation(shown.cars.back().attitude), shown.cars.back().at_m);
  }
  scene.commit();
  Noise noise{seed, 1};
  shown.image = camera_image(unit, scene, {ours(), shown.cars, {}}, look, noise);
  return shown;
}

// Of the pixels that show it, the middle and the size.
struct Bounds {
  int left = 10'000, right = -1, upper = 10'000, lower = -1;
};
Bounds bounds_of(const CameraImage& image, int car) {
  Bounds b;
  for (int v = 0; v < image.height_px; ++v)
    for (int u = 0; u < image.width_px; ++u)
      if (image.car[static_cast<std::size_t>(v * image.width_px + u)] == car) {
        b.left = std::min(b.left, u), b.right = std::max(b.right, u);
        b.upper = std::min(b.upper, v), b.lower = std::max(b.lower, v);
      }
  return b;
}

// By the pinhole equation: focal length times size over distance, to the rear of the car.
TEST(Camera, ACarIsAsLargeAsThePinholeHasIt) {
  for (const double apart_m : {20.0, 50.0, 90.0}) {
    const Shown shown =
        show(ahead(), {traffic::pose_on_oval(kOurs_m + apart_m, 0.0, 60.0)}, daylight());
    const Bounds b = bounds_of(shown.image, 0);
    const double rear_m = apart_m - 0.6 - 2.46;
    EXPECT_NEAR(b.right - b.left, 1'000.0 * 1.89 / (rear_m + 1.0), 0.06 * 1'890.0 / rear_m + 1.5);
    EXPECT_NEAR(0.5 * (b.right + b.left), 335.5, 2.5) << apart_m;
    EXPECT_LE(b.lower - b.upper, 1'000.0 * 1.16 / rear_m + 2.0);
    EXPECT_GE(b.lower - b.upper, 1'000.0 * 1.0 / (apart_m + 2.0) - 2.0);
  }
}

TEST(Camera, LeftOfUsIsLeftInTheImage) {
  const Shown shown = show(ahead(),
                           {traffic::pose_on_oval(kOurs_m + 30.0, 4.0, 60.0),
                            traffic::pose_on_oval(kOurs_m + 30.0, -4.0, 60.0)},
                           daylight());
  EXPECT_LT(bounds_of(shown.image, 0).right, 335);
  EXPECT_GT(bounds_of(shown.image, 1).left, 335);
  // Our bank is 0.1 rad, its left side lower, and we lie with it.
  EXPECT_NEAR(bounds_of(shown.image, 0).lower, bounds_of(shown.image, 1).lower, 4);
}

TEST(Camera, ANearerCarHidesAFurtherOne) {
  const std::vector<plant::CarPose> both{traffic::pose_on_oval(kOurs_m + 15.0, 0.0, 60.0),
                                         traffic::pose_on_oval(kOurs_m + 60.0, 0.0, 60.0)};
  const auto pixels = [](const CameraImage& image, int car) {
    return std::ranges::count(image.car, static_cast<std::int8_t>(car));
  };
  const Shown shown = show(ahead(), both, daylight());
  const Shown alone = show(ahead(), {both[1]}, daylight());
  EXPECT_GT(pixels(alone.image, 0), 150);
  EXPECT_LT(pixels(shown.image, 1), pixels(alone.image, 0) / 3);
}

TEST(Camera, ImagesHaveLightAndShade) {
  Look look = daylight();
  const CameraImage day = show(ahead(), {}, look).image;
  const auto mean = [](const CameraImage& image, int first_row, int rows) {
    double sum = 0.0;
    const std::size_t from = 3U * 672U * static_cast<std::size_t>(first_row);
    const std::size_t count = 3U * 672U * static_cast<std::size_t>(rows);
    for (std::size_t i = from; i < from + count; ++i) sum += image.rgb[i];
    return sum / static_cast<double>(count);
  };
  EXPECT_GT(mean(day, 0, 20), mean(day, 260, 60) + 40.0) << "sky over road";
  for (float& gain : look.errors.gain) gain = 0.25F;
  EXPECT_LT(mean(show(ahead(), {}, look).image, 260, 60), 0.7 * mean(day, 260, 60));
}

TEST(Camera, TheSameSeedGivesTheSameImage) {
  const std::vector<plant::CarPose> other{traffic::pose_on_oval(kOurs_m + 30.0, 1.0, 60.0)};
  const CameraImage first = show(ahead(), other, daylight(), 5).image;
  EXPECT_EQ(first.rgb, show(ahead(), other, daylight(), 5).image.rgb);
  EXPECT_NE(first.rgb, show(ahead(), other, daylight(), 6).image.rgb);
  EXPECT_EQ(first.rgb.size(), 3U * 672U * 320U);
}

TEST(Camera, TheTwoOfTheCarLookToBothSides) {
  const auto units = av21_front_cameras();
  ASSERT_EQ(units.size(), 2U);
  EXPECT_GT(units[0].mount.attitude.yaw_rad, 0.0);
  EXPECT_EQ(units[0].mount.attitude.yaw_rad, -units[1].mount.attitude.yaw_rad);
  // A car straight ahead is in both.
  for (const CameraUnit& unit : units) {
    const Shown shown = show(unit, {traffic::pose_on_oval(kOurs_m + 40.0, 0.0, 60.0)}, daylight());
    EXPECT_GT(bounds_of(shown.image, 0).right, 0);
  }
}

}  // namespace
}  // namespace pitwall::sensors
