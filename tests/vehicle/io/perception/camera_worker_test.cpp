// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/perception/camera_worker.hpp"

#include <gtest/gtest.h>

#include <mutex>
#include <optional>

#include "hil/bench/lockstep/rendered_cameras.hpp"
#include "hil/sensors/camera/camera_scene.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"
#include "tests/hil/traffic/oval.hpp"
#include "tests/support/comes_true.hpp"
#include "vehicle/io/perception/image_codec.hpp"

namespace pitwall::io {
namespace {

std::optional<perception::CameraDetector> shipped() {
  auto detector = perception::CameraDetector::read(
      std::string(PITWALL_SOURCE_DIR) + "/" + perception::kCameraNetworkFile,
      [](const std::string& path) { return transport::read_file(path); });
  EXPECT_TRUE(detector) << to_string(detector.error());
  return *std::move(detector);
}

// The first drawn image that shows a car clearly.
sensors::CameraScene scene_with_a_car() {
  sensors::CameraSceneMaker maker{traffic::oval(), {sensors::av21_shape()}, {.dust = 0.0}};
  for (std::uint64_t seed = 0;; ++seed) {
    sensors::CameraScene scene = maker.make(seed);
    if (scene.cars.size() == 1 && scene.cars[0].pixels > 400) return scene;
  }
}

// A camera without a network between it and the worker.
class Camera {
 public:
  Camera(const sensors::CameraUnit& unit, std::uint8_t number)
      : row_{bench::mounting_of(unit), number} {}

  CameraSource source() {
    return {row_, [this](perception::Image& image) { return take(image); }};
  }
  void send(const sensors::CameraImage& image, Duration ago, const std::string& encoding = "rgb8") {
    ros::Image message;
    message.header.stamp = ros::time_of(UtcTime{transport::utc_now().ns - ago.ns});
    message.width = static_cast<std::uint32_t>(image.width_px);
    message.height = static_cast<std::uint32_t>(image.height_px);
    message.encoding = encoding, message.step = 3 * message.width, message.data = image.rgb;
    const std::lock_guard lock{mutex_};
    next_ = std::move(message);
  }

 private:
  CameraSource::Taken take(perception::Image& image) {
    const std::lock_guard lock{mutex_};
    if (!next_) return {nullptr, nullptr};
    taken_ = *std::move(next_);
    next_.reset();
    return {&taken_.header, read_image(taken_, image)};
  }

  CameraRow row_;
  std::mutex mutex_;
  std::optional<ros::Image> next_;
  ros::Image taken_;  // of the worker's thread
};

TEST(CameraWorker, MakesAFrameOfEachImage) {
  const sensors::CameraScene scene = scene_with_a_car();
  Camera left{scene.unit, 0}, right{scene.unit, 1};
  const auto worker = CameraWorker::start({left.source(), right.source()}, shipped());
  ASSERT_NE(worker, nullptr);
  const double bearing_rad = std::atan2(scene.cars[0].y_m, scene.cars[0].x_m);
  std::uint64_t sent = 0;
  for (Camera* const camera : {&left, &right}) {
    const Instant before = transport::monotonic_now();
    camera->send(scene.image, milliseconds(30));
    const Instant after = transport::monotonic_now();
    ++sent;
    ASSERT_TRUE(testing::comes_true([&] { return worker->counts().images == sent; }));
    ASSERT_NE(worker->front(), nullptr);
    const world::DetectionFrame& frame = *worker->front();
    EXPECT_EQ(frame.source, world::DetectionSource::kCamera);
    EXPECT_EQ(frame.unit, sent - 1);
    EXPECT_GT(frame.at, before - milliseconds(60)) << "30 ms ago";
    EXPECT_LT(frame.at, after);
    ASSERT_EQ(frame.detections.size(), 1U);
    EXPECT_NEAR(frame.detections[0].bearing_rad, bearing_rad, 0.01);
    worker->pop(transport::monotonic_now());
  }
}

TEST(CameraWorker, WhatCannotBeUsedIsCounted) {
  const sensors::CameraScene scene = scene_with_a_car();
  Camera other{scene.unit, 1}, camera{scene.unit, 2};
  const auto worker = CameraWorker::start({other.source(), camera.source()}, shipped());
  camera.send(scene.image, milliseconds(700));
  ASSERT_TRUE(testing::comes_true([&] { return worker->counts().bad_stamps == 1; }));
  camera.send(scene.image, milliseconds(-200));
  ASSERT_TRUE(testing::comes_true([&] { return worker->counts().bad_stamps == 2; }));
  camera.send(scene.image, milliseconds(30), "yuv422");
  ASSERT_TRUE(testing::comes_true([&] { return worker->counts().unreadable == 1; }));
  EXPECT_EQ(worker->front(), nullptr);
  ASSERT_TRUE(testing::comes_true([&] { return worker->drops(2) == 3; })) << "of this camera";
  EXPECT_EQ(worker->drops(1), 0U);
  EXPECT_EQ(worker->drops(0), 0U) << "no camera of ours";
  camera.send(scene.image, milliseconds(30));
  ASSERT_TRUE(testing::comes_true([&] { return worker->counts().images == 1; })) << "it goes on";
  const std::string row = worker->json(transport::monotonic_now());
  EXPECT_NE(row.find("\"bad_stamps\": 2"), std::string::npos) << row;
  EXPECT_NE(row.find("\"unreadable\": 1"), std::string::npos) << row;
}

TEST(CameraWorker, WithoutASourceOrANetworkThereIsNone) {
  EXPECT_EQ(CameraWorker::start({}, shipped()), nullptr);
  const sensors::CameraUnit unit = sensors::av21_front_cameras()[0];
  Camera camera{unit, 0};
  EXPECT_EQ(CameraWorker::start({camera.source()}, std::nullopt), nullptr);
}

}  // namespace
}  // namespace pitwall::io
