// Simulated detections on their way from the bench to the car, by the wall clock: what the car has,
// and the time by which it dates it.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "hil/bench/live/publishers/detection_publisher.hpp"
#include "protocol/transport/clock.hpp"
#include "vehicle/io/ingress/sensor_ingress.hpp"

namespace pitwall::bench {
namespace {

using world::DetectionFrame, world::DetectionSource;

io::SensorFile file_of(int domain) {
  io::DetectionRow camera, radar;
  camera.camera = perception::CameraModel::pinhole(2'000.0, 960.0), camera.height_m = 1.2;
  radar.amplitude_0_db = -10.0, radar.amplitude_1_db = 30.0;
  return {.domain = {.domain = domain},
          .sensors = {{"lidar", "/lidar", io::SensorType::kDetection3DArray, 20.0, {}},
                      {"camera", "/camera", io::SensorType::kDetection2DArray, 20.0, camera},
                      {"radar", "/radar", io::SensorType::kRadarScan, 20.0, radar}}};
}

// Another car stands 30 m ahead of ours.
TEST(DetectionFeed, TheCarHasWhatWasMeasuredAndWhen) {
  constexpr Duration kStep = milliseconds(5), kTimeout = seconds(30);
  constexpr std::size_t kEach = 20;
  auto ingress = io::SensorIngress::start(file_of(67));
  ASSERT_TRUE(ingress) << to_string(ingress.error());
  auto publisher = DetectionPublisher::open(file_of(67), sensors::av21_detection_sensors(), {}, 1);
  ASSERT_TRUE(publisher) << to_string(publisher.error());
  const plant::CarPose ours{.x_m = 100.0,
                            .y_m = 200.0,
                            .yaw_rad = 0.5,
                            .vx_mps = 0.0,
                            .vy_mps = 0.0,
                            .length_m = 4.92,
                            .width_m = 1.89};
  plant::CarPose other = ours;
  other.x_m += 30.0 * std::cos(0.5), other.y_m += 30.0 * std::sin(0.5);
  const Instant started = transport::monotonic_now();
  std::array<std::vector<DetectionFrame>, world::kDetectionSources> received;
  const auto is_enough = [&] {
    return std::ranges::all_of(received, [](const auto& of) { return of.size() >= kEach; });
  };
  for (Instant at{}; !is_enough() && at - Instant{} < kTimeout; at += kStep) {
    transport::sleep_until(started + (at - Instant{}));
    publisher->step({ours, std::span{&other, 1}}, at, started);
    for (const DetectionFrame& frame : (*ingress)->take_detections())
      received[static_cast<std::size_t>(frame.source)].push_back(frame);
  }
  ASSERT_TRUE(is_enough()) << (*ingress)->json(transport::monotonic_now());
  EXPECT_EQ(publisher->lost(), 0U);
  for (const auto& frames : received) {
    std::size_t in_time = 0;
    for (const DetectionFrame& frame : frames) {
      // Every measurement is at a step of the bench; a thread may be held up between two clocks.
      const std::int64_t off_ns = (frame.at - started).ns % kStep.ns;
      in_time += std::min(off_ns, kStep.ns - off_ns) < 500'000;
      EXPECT_GE(frame.received - frame.at, milliseconds(30)) << "its latency is on the way";
      ASSERT_LE(frame.detections.size(), 2U);
    }
    EXPECT_GE(static_cast<double>(in_time), 0.8 * static_cast<double>(frames.size()));
  }
  // Five sigma each; one that is missed or false is no matter here.
  const auto near = [&](DetectionSource source, auto is_it) {
    std::size_t found = 0;
    for (const DetectionFrame& frame : received[static_cast<std::size_t>(source)])
      found += std::ranges::any_of(frame.detections, is_it);
    return static_cast<double>(found) / static_cast<double>(kEach);
  };
  EXPECT_GE(near(DetectionSource::kLidar,
                 [](const auto& d) { return std::hypot(d.x_m - 30.0, d.y_m) < 0.8; }),
            0.7);
  EXPECT_GE(near(DetectionSource::kCamera,
                 [](const auto& d) {
                   return std::abs(d.bearing_rad) < 0.005 &&
                          std::abs(1.0 / d.inverse_depth_per_m - 30.0) < 2.0;
                 }),
            0.7);
  EXPECT_GE(near(DetectionSource::kRadar,
                 [](const auto& d) {
                   return std::abs(d.range_m - 30.0) < 2.5 && std::abs(d.range_rate_mps) < 0.75;
                 }),
            0.7);
}

}  // namespace
}  // namespace pitwall::bench
