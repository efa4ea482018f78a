// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/perception/camera/camera_detector.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "hil/bench/lockstep/rendered_cameras.hpp"
#include "hil/sensors/camera/camera_scene.hpp"
#include "protocol/transport/file.hpp"
#include "tests/hil/traffic/oval.hpp"

namespace pitwall::perception {
namespace {

std::optional<CameraDetector> shipped() {
  auto detector =
      CameraDetector::read(std::string(PITWALL_SOURCE_DIR) + "/" + kCameraNetworkFile,
                           [](const std::string& path) { return transport::read_file(path); });
  EXPECT_TRUE(detector) << to_string(detector.error());
  return *std::move(detector);
}

Image image_of(const sensors::CameraImage& image) {
  return {static_cast<std::size_t>(image.width_px), static_cast<std::size_t>(image.height_px),
          image.rgb};
}

CameraMounting ahead() {
  return {{.x_m = 0.6, .y_m = 0.2, .z_m = 0.7}, {1'000.0, 1'000.0, 335.5, 159.5, {}}, 1.16};
}

TEST(CameraDetector, DepthIsFocalLengthTimesHeightOverPixels) {
  const auto seen =
      detection_of({.u_px = 335.5, .v_px = 170.0, .upright_px = 23.2, .confidence = 0.8}, ahead());
  ASSERT_TRUE(seen);
  EXPECT_NEAR(1.0 / seen->inverse_depth_per_m, std::hypot(50.6, 0.2), 1e-9) << "from Body";
  EXPECT_NEAR(seen->bearing_rad, std::atan2(0.2, 50.6), 1e-9);
  EXPECT_EQ(seen->confidence, 0.8);
}

TEST(CameraDetector, ACarIsWhereItsCentreProjectsFromAnyMount) {
  CameraMounting camera = ahead();
  for (const double yaw_deg : {-14.0, 0.0, 14.0, 120.0})
    for (const double roll_deg : {0.0, 2.0}) {
      camera.pose.yaw_rad = from_deg(yaw_deg), camera.pose.pitch_rad = from_deg(1.5);
      camera.pose.roll_rad = from_deg(roll_deg);
      const std::array<double, 3> in_camera{40.0, -3.0, -0.4};  // ahead, left, up
      const auto at = in_body(camera.pose, axes_of(camera.pose), in_camera);
      const Pixel pixel = project(camera.optics, {3.0 / 40.0, 0.4 / 40.0});
      const auto seen = detection_of(
          {.u_px = pixel.u_px, .v_px = pixel.v_px, .upright_px = 1'000.0 * 1.16 / 40.0}, camera);
      ASSERT_TRUE(seen);
      EXPECT_NEAR(seen->bearing_rad, std::atan2(at[1], at[0]), 1e-9);
      EXPECT_NEAR(1.0 / seen->inverse_depth_per_m, std::hypot(at[0], at[1]), 1e-9);
    }
}

TEST(CameraDetector, WithoutANameThereIsNone) {
  const auto none =
      CameraDetector::read("", [](const std::string&) -> Result<std::string, Problem> {
        ADD_FAILURE() << "nothing to read";
        return std::string();
      });
  ASSERT_TRUE(none);
  EXPECT_FALSE(none->has_value());
  const auto bad = CameraDetector::read(
      "x.onnx",
      [](const std::string&) -> Result<std::string, Problem> { return std::string("?"); });
  ASSERT_FALSE(bad);
  EXPECT_NE(to_string(bad.error()).find("x.onnx"), std::string::npos);
}

bool is_whole(const sensors::SeenCar& car) {
  return car.u_px > 0.5 * car.width_px && car.u_px < 671.0 - 0.5 * car.width_px &&
         car.v_px > 0.5 * car.height_px && car.v_px < 319.0 - 0.5 * car.height_px;
}

// Those in plain view, whole in the image and without dust; `bench camera` says how well it does.
TEST(CameraDetector, FindsTheCarsOfDrawnImages) {
  auto detector = shipped();
  ASSERT_TRUE(detector);
  sensors::CameraSceneMaker maker{traffic::oval(), {sensors::av21_shape()}, {.dust = 0.0}};
  constexpr std::uint64_t kLooked = 40;
  std::size_t asked = 0, found = 0, boxes = 0, shown = 0;
  for (std::uint64_t seed = 0; seed < kLooked; ++seed) {
    const sensors::CameraScene scene = maker.make(seed);
    const auto frame = detector->detect(image_of(scene.image), bench::mounting_of(scene.unit),
                                        static_cast<std::uint8_t>(seed % 2), Instant{});
    EXPECT_EQ(frame.source, world::DetectionSource::kCamera);
    EXPECT_EQ(frame.unit, seed % 2);
    boxes += frame.detections.size(), shown += scene.cars.size();
    for (const sensors::SeenCar& car : scene.cars) {
      if (car.pixels < 250 || !is_whole(car)) continue;
      ++asked;
      found += std::ranges::any_of(frame.detections, [&](const world::Detection& d) {
        const double range_m = std::hypot(car.x_m, car.y_m);
        return std::abs(wrap_pi(d.bearing_rad - std::atan2(car.y_m, car.x_m))) < 0.02 &&
               std::abs(d.inverse_depth_per_m * range_m - 1.0) < 0.25;
      });
    }
  }
  EXPECT_GE(asked, 15U) << "or the test has seen next to nothing";
  EXPECT_GE(10 * found, 9 * asked);
  EXPECT_LE(boxes, shown + 4) << "or it sees what is not there";
  EXPECT_EQ(detector->counts().images, kLooked);
}

// A larger image is the same one in smaller pixels.
TEST(CameraDetector, BoxesAreInPixelsOfTheImageThatItWasGiven) {
  auto detector = shipped();
  ASSERT_TRUE(detector);
  sensors::CameraSceneMaker maker{traffic::oval(), {sensors::av21_shape()}, {}};
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const Image image = image_of(maker.make(seed).image);
    const auto boxes = detector->boxes_in(image);
    if (boxes.empty()) continue;
    Image twice{2 * image.width_px, 2 * image.height_px, {}};
    for (std::size_t v = 0; v < twice.height_px; ++v)
      for (std::size_t u = 0; u < twice.width_px; ++u)
        twice.rgb.insert(twice.rgb.end(), image.pixel(u / 2, v / 2), image.pixel(u / 2, v / 2) + 3);
    const auto again = detector->boxes_in(twice);
    ASSERT_EQ(again.size(), boxes.size());
    EXPECT_NEAR(again[0].u_px, 2.0 * boxes[0].u_px + 0.5, 1e-3);
    EXPECT_NEAR(again[0].v_px, 2.0 * boxes[0].v_px + 0.5, 1e-3);
    EXPECT_NEAR(again[0].upright_px, 2.0 * boxes[0].upright_px, 1e-3);
    return;
  }
  FAIL() << "no car in any image";
}

}  // namespace
}  // namespace pitwall::perception
