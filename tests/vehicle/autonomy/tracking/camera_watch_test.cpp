// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/tracking/camera_watch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "tests/support/draw.hpp"

namespace pitwall::tracking {
namespace {

constexpr double kFast_mps = 70.0, kYawRate_rad_per_s = 0.3;  // ours: a turn of 230 m

// Ours on an arc, and another car ahead on the same one, somewhat faster.
OwnMotion own_at(double time_s) {
  const double radius_m = kFast_mps / kYawRate_rad_per_s, yaw_rad = kYawRate_rad_per_s * time_s;
  return {.x_m = radius_m * std::sin(yaw_rad),
          .y_m = radius_m * (1.0 - std::cos(yaw_rad)),
          .yaw_rad = yaw_rad,
          .vx_mps = kFast_mps * std::cos(yaw_rad),
          .vy_mps = kFast_mps * std::sin(yaw_rad)};
}

struct Seen {
  double x_m, y_m;  // Body
};
Seen other_at(double time_s, double ahead_m) {
  const double radius_m = kFast_mps / kYawRate_rad_per_s;
  const double turn_rad = (ahead_m + 4.0 * time_s) / radius_m;
  return {radius_m * std::sin(turn_rad), radius_m * (1.0 - std::cos(turn_rad))};
}

AdmittedFrame frame(world::DetectionSource source, std::uint8_t unit, double time_s) {
  AdmittedFrame made;
  made.key = {Instant{} + from_seconds(time_s), source, unit};
  made.own = own_at(time_s);
  return made;
}

struct Fault {
  double bearing_rad = 0.0, ratio = 1.0;
};

// Twenty sweeps and ten images a second, the LiDAR's frames 25 ms aside, for `span_s`.
CameraWatch watched(const std::vector<double>& ahead_m, const Fault& fault, double span_s,
                    std::uint8_t unit = 0) {
  CameraWatch watch;
  std::mt19937_64 random{9};
  for (int i = 0; i < static_cast<int>(20.0 * span_s); ++i) {
    const double time_s = 0.05 * i;
    AdmittedFrame lidar = frame(world::DetectionSource::kLidar, 0, time_s);
    for (const double from_m : ahead_m) {
      const Seen car = other_at(time_s, from_m);
      EXPECT_TRUE(lidar.measurements.push({{car.x_m + ::pitwall::testing::draw_normal(random, 0.1),
                                            car.y_m + ::pitwall::testing::draw_normal(random, 0.1)},
                                           0.9}));
    }
    watch.note(lidar);
    if (i % 2 != 0) continue;
    AdmittedFrame camera = frame(world::DetectionSource::kCamera, unit, time_s + 0.025);
    for (const double from_m : ahead_m) {
      const Seen car = other_at(time_s + 0.025, from_m);
      const double bearing_rad = std::atan2(car.y_m, car.x_m) + fault.bearing_rad;
      const double noise_rad = ::pitwall::testing::draw_normal(random, 0.001);
      EXPECT_TRUE(camera.measurements.push(
          {{bearing_rad + noise_rad, 1.0 / (fault.ratio * std::hypot(car.x_m, car.y_m))}, 0.9}));
    }
    watch.note(camera);
  }
  return watch;
}

TEST(CameraWatch, FindsNothingWhereNothingIsOff) {
  const world::CameraBias bias = watched({40.0}, {}, 15.0).bias(0);
  EXPECT_NEAR(bias.bearing_rad, 0.0, 0.0008);
  EXPECT_NEAR(bias.distance_ratio, 1.0, 0.005);
}

TEST(CameraWatch, FindsTheBearingThatACameraWasKnockedBy) {
  for (const double off_rad : {-0.03, 0.006, 0.05}) {
    const world::CameraBias bias = watched({40.0}, {.bearing_rad = off_rad}, 15.0, 1).bias(1);
    EXPECT_NEAR(bias.bearing_rad, off_rad, 0.0008);
    EXPECT_NEAR(bias.distance_ratio, 1.0, 0.005);
  }
}

TEST(CameraWatch, FindsTheDistancesOfAWrongFocalLength) {
  const world::CameraBias bias = watched({40.0}, {.ratio = 1.2}, 15.0).bias(0);
  EXPECT_NEAR(bias.distance_ratio, 1.2, 0.006);
}

TEST(CameraWatch, SaysNothingOfFewCars) {
  EXPECT_TRUE(std::isnan(watched({40.0}, {}, 2.5).bias(0).bearing_rad)) << "24 images";
  EXPECT_TRUE(std::isnan(watched({}, {}, 15.0).bias(0).bearing_rad));
  EXPECT_TRUE(std::isnan(watched({40.0}, {}, 15.0).bias(1).bearing_rad)) << "the other camera";
}

TEST(CameraWatch, CarsThatStandTogetherAreNotCompared) {
  // 8 m apart, one after the other, in one direction from us.
  EXPECT_TRUE(std::isnan(watched({40.0, 48.0}, {}, 15.0).bias(0).bearing_rad));
  // In a turn, in two directions.
  EXPECT_FALSE(std::isnan(watched({15.0, 75.0}, {}, 15.0).bias(0).bearing_rad));
}

TEST(CameraWatch, WithoutLidarsThereIsNothingToCompareWith) {
  CameraWatch watch;
  for (int i = 0; i < 200; ++i) {
    AdmittedFrame camera = frame(world::DetectionSource::kCamera, 0, 0.1 * i);
    ASSERT_TRUE(camera.measurements.push({{0.0, 0.02}, 0.9}));
    watch.note(camera);
  }
  EXPECT_TRUE(std::isnan(watch.bias(0).bearing_rad));
}

}  // namespace
}  // namespace pitwall::tracking
