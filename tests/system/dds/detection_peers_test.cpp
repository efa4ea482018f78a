// Detections of other cars that another DDS publishes, and what the car makes of them; ours, as
// another DDS reads them.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <peer.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "protocol/dds/domain.hpp"
#include "protocol/ros/cdr.hpp"
#include "tests/system/dds/cyclone_peer.hpp"
#include "vehicle/io/ingress/detection_codec.hpp"
#include "vehicle/io/ingress/sensor_ingress.hpp"

namespace pitwall::io::detection_peers {
namespace {

using pitwall::testing::comes;
using pitwall::testing::CyclonePeer;
using world::Detection, world::DetectionFrame, world::DetectionSource;

constexpr pitwall::testing::Ask kSensorData{.reliable = false, .depth = 5};
constexpr const char* kBoxes = "vision_msgs::msg::dds_::Detection3DArray_";
constexpr const char* kImages = "vision_msgs::msg::dds_::Detection2DArray_";
constexpr const char* kScans = "radar_msgs::msg::dds_::RadarScan_";
constexpr std::size_t kLidar = 0, kCamera = 1, kRadar = 2;

SensorFile file_of(int domain) {
  DetectionRow camera, radar;
  camera.camera = perception::CameraModel::pinhole(1'000.0, 960.0), camera.height_m = 1.2;
  radar.amplitude_0_db = 0.0, radar.amplitude_1_db = 40.0;
  return {.domain = {.domain = domain},
          .sensors = {{"lidar", "/lidar", SensorType::kDetection3DArray, 20.0, {}},
                      {"camera", "/camera", SensorType::kDetection2DArray, 20.0, camera},
                      {"radar", "/radar", SensorType::kRadarScan, 20.0, radar}}};
}

char g_base_link[] = "base_link", g_map[] = "map", g_car[] = "car", g_empty[] = "";

peer_Header header_at(Duration ago, char* frame = g_base_link) {
  const std::int64_t ns = transport::utc_now().ns - ago.ns;
  return {{static_cast<std::int32_t>(ns / kNanosecondsPerSecond),
           static_cast<std::uint32_t>(ns % kNanosecondsPerSecond)},
          frame};
}

// One car ahead, 90 ms ago, as each of the three would say it.
struct Messages {
  peer_HypothesisWithPose hypothesis{{g_car, 0.75}, {}};
  peer_Detection3 box{};
  peer_Detections3 boxes{};
  peer_Detection2 image{};
  peer_Detections2 images{};
  peer_RadarReturn echo{50.0F, 0.1F, 0.0F, -12.5F, 30.0F};
  peer_RadarScan scan{};

  explicit Messages(Duration ago = milliseconds(90), char* frame = g_base_link) {
    box.header = image.header = header_at({}, g_empty);
    box.results = image.results = {1, 1, &hypothesis, false};
    box.id = image.id = g_empty;
    box.bbox.center.position = {50.0, 5.0, 0.5};
    box.bbox.center.orientation = {0.0, 0.0, std::sin(0.1), std::cos(0.1)};
    box.bbox.size = {4.9, 1.9, 1.2};
    image.bbox = {{{860.0, 500.0}, 0.0}, 60.0, 24.0};
    boxes = {header_at(ago, frame), {1, 1, &box, false}};
    images = {header_at(ago, frame), {1, 1, &image, false}};
    scan = {header_at(ago, frame), {1, 1, &echo, false}};
  }
};

TEST(DetectionPeers, WhatAnotherDdsPublishesReachesTrackingAsItWasMeasured) {
  auto ingress = SensorIngress::start(file_of(63));
  ASSERT_TRUE(ingress) << to_string(ingress.error());
  CyclonePeer peer{63};
  const auto lidar = peer.writer(peer_Detections3_desc, kBoxes, "rt/lidar", kSensorData);
  const auto camera = peer.writer(peer_Detections2_desc, kImages, "rt/camera", kSensorData);
  const auto radar = peer.writer(peer_RadarScan_desc, kScans, "rt/radar", kSensorData);
  std::array<DetectionFrame, world::kDetectionSources> newest;
  std::array<bool, world::kDetectionSources> has{};
  ASSERT_TRUE(comes([&] {
    const Messages now;
    dds_write(lidar, &now.boxes), dds_write(camera, &now.images), dds_write(radar, &now.scan);
    Instant before{};
    for (const DetectionFrame& frame : (*ingress)->take_detections()) {
      EXPECT_GE(frame.received, before) << "in order of arrival";
      before = frame.received;
      newest[static_cast<std::size_t>(frame.source)] = frame;
      has[static_cast<std::size_t>(frame.source)] = true;
    }
    return has[0] && has[1] && has[2];
  })) << (*ingress)->json(transport::monotonic_now());
  for (const DetectionFrame& frame : newest) {
    ASSERT_EQ(frame.detections.size(), 1U);
    EXPECT_GE(frame.received - frame.at, milliseconds(90));
    EXPECT_LT(frame.received - frame.at, seconds(1)) << "of its way between two threads";
  }
  const Detection &box = newest[kLidar].detections[0], &image = newest[kCamera].detections[0],
                  &echo = newest[kRadar].detections[0];
  EXPECT_EQ(box.x_m, 50.0);
  EXPECT_EQ(box.y_m, 5.0);
  EXPECT_NEAR(box.yaw_rad, 0.2, 1e-12);
  EXPECT_EQ(box.length_m, 4.9);
  EXPECT_EQ(box.width_m, 1.9);
  EXPECT_EQ(box.confidence, 0.75);
  EXPECT_NEAR(image.bearing_rad, std::atan(0.1), 1e-12) << "left of the middle";
  EXPECT_NEAR(image.inverse_depth_per_m, 0.02 * std::cos(std::atan(0.1)), 1e-12);
  EXPECT_EQ(echo.range_m, 50.0);
  EXPECT_NEAR(echo.bearing_rad, 0.1, 1e-7);
  EXPECT_EQ(echo.range_rate_mps, -12.5);
  EXPECT_EQ(echo.confidence, 0.75);
  EXPECT_NE((*ingress)->json(transport::monotonic_now()).find("\"bad_detections\":"),
            std::string::npos);
}

// The camera sends nothing but bad messages of every kind; the LiDAR beside it is not disturbed.
TEST(DetectionPeers, BadMessagesOfOneSensorAreCountedAndTheOthersGoOn) {
  auto ingress = SensorIngress::start(file_of(64));
  ASSERT_TRUE(ingress) << to_string(ingress.error());
  CyclonePeer peer{64};
  const auto lidar = peer.writer(peer_Detections3_desc, kBoxes, "rt/lidar", kSensorData);
  const auto camera = peer.writer(peer_Detections2_desc, kImages, "rt/camera", kSensorData);
  const auto cut = peer.writer(peer_Other_desc, kImages, "rt/camera", kSensorData);
  const auto foreign =
      peer.writer(peer_Imu_desc, "sensor_msgs::msg::dds_::Imu_", "rt/camera", kSensorData);
  std::size_t from_lidar = 0;
  ASSERT_TRUE(comes([&] {
    Messages good, future{-seconds(1)}, old{seconds(20)}, elsewhere{milliseconds(90), g_map};
    Messages nan, many;
    nan.image.bbox.size_y = std::nan("");
    std::vector<peer_Detection2> crowd(1'000, many.image);
    many.images.detections = {1'000, 1'000, crowd.data(), false};
    const peer_Other other{.number = 1};
    peer_Imu sample{};
    sample.header = header_at({});
    dds_write(cut, &other), dds_write(foreign, &sample);
    for (const auto* bad :
         {&future.images, &old.images, &elsewhere.images, &nan.images, &many.images})
      dds_write(camera, bad);
    dds_write(lidar, &good.boxes);
    for (const DetectionFrame& frame : (*ingress)->take_detections()) {
      from_lidar += frame.source == DetectionSource::kLidar;
      EXPECT_TRUE(frame.source == DetectionSource::kLidar || frame.detections.empty());
    }
    const SensorCounts n = (*ingress)->counts(kCamera);
    const DetectionCounts& d = n.detections;
    return n.foreign_types >= 1 && d.refused >= 3 && d.in_future >= 3 && d.too_old >= 3 &&
           d.foreign_frames >= 3 && d.too_many >= 3 && d.bad_detections >= 3 && from_lidar >= 3;
  })) << (*ingress)->json(transport::monotonic_now());
  EXPECT_EQ((*ingress)->counts(kLidar).detections.refused, 0U);
  EXPECT_EQ((*ingress)->counts(kRadar).samples, 0U);
}

dds::Writer* writer_of(dds::Domain& domain, const char* topic, const char* type) {
  const auto writer = domain.write_to({topic, type}, {});
  EXPECT_TRUE(writer);
  return writer ? *writer : nullptr;
}

template <class M>
void send(dds::Writer& writer, const M& message) {
  std::vector<std::uint8_t> bytes;
  ros::encode(message, bytes);
  EXPECT_TRUE(writer.write(bytes));
}

TEST(DetectionPeers, OursAreReadByAnotherDds) {
  auto domain = dds::Domain::join({.domain = 65});
  ASSERT_TRUE(domain) << to_string(domain.error());
  CyclonePeer peer{65};
  const auto boxes = peer.reader(peer_Detections3_desc, kBoxes, "rt/lidar");
  const auto images = peer.reader(peer_Detections2_desc, kImages, "rt/camera");
  const auto scans = peer.reader(peer_RadarScan_desc, kScans, "rt/radar");
  dds::Writer* const lidar = writer_of(**domain, "rt/lidar", kBoxes);
  dds::Writer* const camera = writer_of(**domain, "rt/camera", kImages);
  dds::Writer* const radar = writer_of(**domain, "rt/radar", kScans);
  ASSERT_TRUE(comes([&] {
    return lidar->readers() > 0 && camera->readers() > 0 && radar->readers() > 0 &&
           CyclonePeer::has_writer(boxes) && CyclonePeer::has_writer(images) &&
           CyclonePeer::has_writer(scans);
  }));
  const SensorFile file = file_of(65);
  const auto frame_of = [](DetectionSource source, const Detection& d) {
    DetectionFrame frame{.source = source, .detections = {}};
    EXPECT_TRUE(frame.detections.push(d) && frame.detections.push(d));
    return frame;
  };
  send(*lidar, box_message(file.sensors[0].detections,
                           frame_of(DetectionSource::kLidar,
                                    {.confidence = 0.5, .x_m = 1.5, .y_m = 2.5, .yaw_rad = 0.2})));
  send(*camera, image_message(file.sensors[1].detections,
                              frame_of(DetectionSource::kCamera, {.confidence = 0.5,
                                                                  .bearing_rad = std::atan(0.1),
                                                                  .inverse_depth_per_m = 0.02})));
  send(*radar, radar_message(file.sensors[2].detections,
                             frame_of(DetectionSource::kRadar, {.confidence = 0.5,
                                                                .bearing_rad = 0.1,
                                                                .range_m = 50.0,
                                                                .range_rate_mps = 3.0})));
  EXPECT_TRUE(comes([&] {
    const auto sample = CyclonePeer::take<peer_Detections3>(boxes);
    if (!sample) return false;
    EXPECT_STREQ(sample->header.frame_id, "base_link");
    EXPECT_EQ(sample->detections._length, 2U);
    const peer_Detection3& d = sample->detections._buffer[1];
    EXPECT_EQ(d.bbox.center.position.x, 1.5);
    EXPECT_EQ(d.bbox.center.position.y, 2.5);
    EXPECT_NEAR(d.bbox.center.orientation.z, std::sin(0.1), 1e-12);
    EXPECT_EQ(d.results._buffer[0].hypothesis.score, 0.5);
    return true;
  }));
  EXPECT_TRUE(comes([&] {
    const auto sample = CyclonePeer::take<peer_Detections2>(images);
    if (!sample) return false;
    EXPECT_NEAR(sample->detections._buffer[1].bbox.center.position.x, 860.0, 1e-9);
    EXPECT_NEAR(sample->detections._buffer[1].bbox.size_y, 24.0 / std::cos(std::atan(0.1)), 1e-9);
    return true;
  }));
  EXPECT_TRUE(comes([&] {
    const auto sample = CyclonePeer::take<peer_RadarScan>(scans);
    if (!sample) return false;
    EXPECT_EQ(sample->returns._length, 2U);
    const peer_RadarReturn& echo = sample->returns._buffer[1];
    EXPECT_EQ(echo.range, 50.0F);
    EXPECT_EQ(echo.azimuth, 0.1F);
    EXPECT_EQ(echo.doppler_velocity, 3.0F);
    EXPECT_EQ(echo.amplitude, 20.0F);
    return true;
  }));
}

}  // namespace
}  // namespace pitwall::io::detection_peers
