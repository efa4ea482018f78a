// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/lockstep/rendered_cameras.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "protocol/transport/file.hpp"
#include "tests/hil/traffic/oval_cars.hpp"

namespace pitwall::bench {
namespace {

constexpr double kFast_mps = 60.0, kFrom_m = 100.0;  // on the straight, at time 0

perception::CameraDetector shipped() {
  auto detector = perception::CameraDetector::read(
      std::string(PITWALL_SOURCE_DIR) + "/" + perception::kCameraNetworkFile,
      [](const std::string& path) { return transport::read_file(path); });
  EXPECT_TRUE(detector) << to_string(detector.error());
  return **std::move(detector);
}

// All cars at the same speed, for `span`.
std::vector<world::DetectionFrame> images_of(const std::vector<plant::CarPose>& others,
                                             Duration span, const faults::CameraFault& fault = {}) {
  RenderedCameras cameras{traffic::oval(), others.size(), 7, shipped()};
  std::vector<world::DetectionFrame> frames;
  for (Instant now{}; now - Instant{} < span; now += milliseconds(10)) {
    const double went_m = kFast_mps * now.seconds();
    std::vector<plant::CarPose> moved;
    for (const plant::CarPose& car : others)
      moved.push_back(traffic::pose_on_oval(car.s_m + went_m, car.n_m, kFast_mps));
    sensors::Arrivals arrivals;
    cameras.step(traffic::truth_on_oval(kFrom_m + went_m, kFast_mps), moved, fault, now, arrivals);
    for (const world::DetectionFrame& frame : arrivals) {
      EXPECT_EQ(frame.received, now);
      frames.push_back(frame);
    }
  }
  return frames;
}

TEST(RenderedCameras, SendAFrameForEachImageTheTwoInTurn) {
  const auto frames = images_of({}, milliseconds(310));
  ASSERT_EQ(frames.size(), 5U);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    EXPECT_EQ(frames[i].unit, i % 2);
    EXPECT_EQ(frames[i].at, Instant{} + static_cast<std::int64_t>(i) * milliseconds(50));
    EXPECT_EQ(frames[i].received, frames[i].at + RenderedCameras::kLatency);
    EXPECT_TRUE(frames[i].detections.empty()) << "an empty track with its walls and its fence";
  }
}

TEST(RenderedCameras, SeeTheOthersWhereTheyAre) {
  const std::vector<plant::CarPose> others{traffic::pose_on_oval(kFrom_m + 20.0, -3.0, kFast_mps),
                                           traffic::pose_on_oval(kFrom_m + 50.0, 3.0, kFast_mps)};
  const auto frames = images_of(others, milliseconds(410));
  std::size_t found = 0, seen = 0;
  for (const world::DetectionFrame& frame : frames)
    for (const world::Detection& d : frame.detections) {
      ++seen;
      found += std::ranges::any_of(others, [&](const plant::CarPose& car) {
        const double x_m = car.s_m - kFrom_m, y_m = car.n_m;
        return std::abs(d.bearing_rad - std::atan2(y_m, x_m)) < 0.012 &&
               std::abs(1.0 - d.inverse_depth_per_m * std::hypot(x_m, y_m)) < 0.15;
      });
    }
  EXPECT_EQ(found, seen);
  EXPECT_GE(found, 6U) << "each camera sees its side";
}

TEST(RenderedCameras, OneThatIsOutSendsNothing) {
  const auto frames = images_of({}, milliseconds(410), {.outage = {true, false}});
  ASSERT_FALSE(frames.empty());
  for (const world::DetectionFrame& frame : frames) EXPECT_EQ(frame.unit, 1);
}

}  // namespace
}  // namespace pitwall::bench
