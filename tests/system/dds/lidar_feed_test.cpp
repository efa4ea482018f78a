// Clouds that the bench publishes of its LiDARs, through shared memory, and the car's own
// perception that finds the other car in them.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "hil/bench/live/publishers/cloud_publisher.hpp"
#include "protocol/transport/clock.hpp"
#include "tests/hil/traffic/oval_cars.hpp"
#include "tests/vehicle/autonomy/perception/lidar/ego_on_oval.hpp"
#include "vehicle/io/perception/lidar_worker.hpp"

namespace pitwall::bench {
namespace {

constexpr double kOurs_m = 102.0, kAhead_m = 20.0, kLeft_m = 3.0;

io::SensorFile front_lidar(int domain) {
  return {.domain = {.domain = domain, .shared_memory_bytes = 1U << 20U},
          .sensors = {{.name = "front",
                       .topic = "/front/points",
                       .type = io::SensorType::kPointCloud2,
                       .rate_hz = 20.0,
                       .lidar = io::LidarRow{.mount = {.x_m = 1.0, .z_m = 0.55},
                                             .horizon = sensors::kHorizon}}}};
}

// The bench for so long; what the car's clusters found ahead, at most `frames`.
struct Seen {
  std::size_t frames = 0, with_car = 0;
  SensorFeed feed{};
};
Seen seen_in(int domain, Duration span, std::size_t frames,
             std::span<const faults::BenchFault> faults) {
  const io::SensorFile file = front_lidar(domain);
  auto ingress = io::SensorIngress::start(file);
  if (!ingress) return ADD_FAILURE() << to_string(ingress.error()), Seen{};
  const auto worker =
      io::LidarWorker::start(io::lidars_of(**ingress), traffic::oval(), std::nullopt);
  auto publisher = CloudPublisher::open(
      file, traffic::oval(), [](double) { return 0.0; }, 7, faults);
  if (!publisher) return ADD_FAILURE() << to_string(publisher.error()), Seen{};
  const plant::Truth ours = traffic::truth_on_oval(kOurs_m, 0.0);
  const plant::CarPose other = traffic::pose_on_oval(kOurs_m + kAhead_m, kLeft_m, 0.0);
  const Instant started = transport::monotonic_now();
  Seen seen;
  for (Instant at{}; at - Instant{} < span && seen.frames < frames; at += milliseconds(1)) {
    transport::sleep_until(started + (at - Instant{}));
    worker->report(perception::ego_on_oval(kOurs_m, 0.0, transport::monotonic_now()));
    (*publisher)->show(ours, kOurs_m, {&other, 1}, at, started);
    while (const world::DetectionFrame* const frame = worker->front()) {
      ++seen.frames;
      for (const world::Detection& d : frame->detections)
        seen.with_car += std::abs(d.x_m - kAhead_m) < 1.0 && std::abs(d.y_m - kLeft_m) < 0.6;
      worker->pop(transport::monotonic_now());
    }
  }
  seen.feed = (*publisher)->counts();
  return seen;
}

TEST(LidarFeed, TheCarFindsTheOtherOneInTheCloudsOfTheBench) {
  const Seen seen = seen_in(70, seconds(30), 40, {});
  EXPECT_EQ(seen.frames, 40U);
  EXPECT_GE(seen.with_car, 36U);
  EXPECT_EQ(seen.feed.refused, 0U);
  EXPECT_GE(seen.feed.sent, 40U);
}

TEST(LidarFeed, ALidarThatIsOutSendsNothing) {
  const std::array outage{faults::BenchFault{.kind = faults::BenchFaultKind::kLidarOutage}};
  const Seen seen = seen_in(71, seconds(2), 1, outage);
  EXPECT_EQ(seen.frames, 0U);
  EXPECT_EQ(seen.feed.sent, 0U);
}

}  // namespace
}  // namespace pitwall::bench
