// Images that the bench publishes of its cameras, through shared memory, and the car's own
// perception that finds the other car in them.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>

#include "hil/bench/live/publishers/image_publisher.hpp"
#include "hil/bench/lockstep/rendered_cameras.hpp"
#include "protocol/ros/cdr.hpp"
#include "protocol/ros/names.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"
#include "tests/hil/traffic/oval_cars.hpp"
#include "tests/system/dds/cyclone_peer.hpp"
#include "vehicle/io/perception/car_sensors.hpp"

namespace pitwall::bench {
namespace {

constexpr double kFrom_m = 102.0, kApart_m = 30.0, kAside_m = 3.0;

io::SensorFile left_camera(int domain) {
  const io::CameraRow camera{mounting_of(sensors::av21_front_cameras()[0]), 0};
  return {.domain = {.domain = domain, .shared_memory_bytes = 1U << 20U},
          .sensors = {{.name = "front_left",
                       .topic = "/front_left/image_raw",
                       .type = io::SensorType::kImage,
                       .rate_hz = 10.0,
                       .camera = camera}}};
}

TEST(CameraFeed, TheCarFindsTheOtherOneInTheImagesOfTheBench) {
  const io::SensorFile file = left_camera(73);
  auto ingress = io::SensorIngress::start(file);
  ASSERT_TRUE(ingress) << to_string(ingress.error());
  auto detector = perception::CameraDetector::read(
      std::string(PITWALL_SOURCE_DIR) + "/" + perception::kCameraNetworkFile,
      [](const std::string& path) { return transport::read_file(path); });
  ASSERT_TRUE(detector) << to_string(detector.error());
  const auto debug = io::DebugTopics::open({.domain = 73});
  ASSERT_TRUE(debug) << to_string(debug.error());
  std::atomic<int> markers{0};
  const auto onlooker = dds::Domain::join({.domain = 73});
  ASSERT_TRUE(onlooker);
  ASSERT_TRUE((*onlooker)->read_from(
      {*ros::dds_topic("/pitwall/debug/camera_cars"), ros::dds_type(ros::MarkerArray::kType), {}},
      dds::kSensorData, [&](dds::Bytes cdr) {
        const auto message = ros::decode<ros::MarkerArray>(cdr);
        if (message && message->markers.size() > 1) ++markers;
      }));
  const auto worker =
      io::CameraWorker::start(io::cameras_of(**ingress), *std::move(detector), debug->get());
  ASSERT_NE(worker, nullptr);
  auto publisher = ImagePublisher::open(file, traffic::oval(), 1, 7, {});
  ASSERT_TRUE(publisher) << to_string(publisher.error());
  const plant::Truth ours = traffic::truth_on_oval(kFrom_m, 0.0);
  const plant::CarPose other = traffic::pose_on_oval(kFrom_m + kApart_m, kAside_m, 0.0);
  const double bearing_rad = std::atan2(kAside_m, kApart_m);
  const Instant started = transport::monotonic_now();
  std::size_t frames = 0, with_car = 0;
  for (Instant at{}; at - Instant{} < seconds(30) && frames < 10; at += milliseconds(5)) {
    transport::sleep_until(started + (at - Instant{}));
    (*publisher)->show(ours, {&other, 1}, at, started);
    for (; worker->front() != nullptr; worker->pop(transport::monotonic_now())) {
      ++frames;
      for (const world::Detection& d : worker->front()->detections)
        with_car += std::abs(d.bearing_rad - bearing_rad) < 0.015 &&
                    std::abs(d.inverse_depth_per_m * std::hypot(kApart_m, kAside_m) - 1.0) <
                        3.0 * perception::kCameraDistanceSigma;
    }
  }
  EXPECT_EQ(frames, 10U);
  EXPECT_GE(with_car, 9U);
  EXPECT_EQ((*publisher)->counts().refused, 0U);
  EXPECT_GT(markers, 0) << "what RViz would show";
  // The camera's figures at the pit wall are those of its images.
  const auto figures =
      (*ingress)->figures(io::SensorType::kDetection2DArray, 0, transport::monotonic_now());
  ASSERT_TRUE(figures);
  EXPECT_GT(figures->arrivals.rate_hz, 0.0);
}

TEST(CameraFeed, AnImageThatCannotBeReadIsADropOfItsCamera) {
  const auto sensors = io::CarSensors::open(
      {.file = std::string(PITWALL_SOURCE_DIR) + "/vehicle/config/sensors/av21_cameras.yaml",
       .domain = 75},
      traffic::oval(), [](const std::string& path) { return transport::read_file(path); });
  ASSERT_TRUE(sensors) << to_string(sensors.error());
  const auto driver = dds::Domain::join({.domain = 75});
  ASSERT_TRUE(driver);
  const auto writer = (*driver)->write_to(
      {*ros::dds_topic("/front_right/image_raw"), ros::dds_type(ros::Image::kType), {}},
      dds::kSensorData);
  ASSERT_TRUE(writer);
  const auto drops_of = [&](std::size_t unit) {
    const auto figures =
        (*sensors)->figures(io::SensorType::kDetection2DArray, unit, transport::monotonic_now());
    return figures ? figures->drops : 0U;
  };
  EXPECT_TRUE(testing::comes([&] {
    ros::Image image = message_of(sensors::CameraImage{});
    image.header.stamp = ros::time_of(transport::utc_now());
    image.encoding = "yuv422";
    std::vector<std::uint8_t> cdr;
    ros::encode(image, cdr);
    (*writer)->write(cdr);
    return drops_of(1) >= 3;
  }));
  EXPECT_EQ(drops_of(0), 0U) << "the other camera's";
}

}  // namespace
}  // namespace pitwall::bench
