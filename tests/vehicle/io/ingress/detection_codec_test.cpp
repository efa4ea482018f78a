// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/ingress/detection_codec.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace pitwall::io {
namespace {

using world::Detection, world::DetectionFrame, world::DetectionSource;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

DetectionRow camera_row() {
  DetectionRow row;
  row.unit = 3, row.frame = "rear_left_camera", row.facing_rad = from_deg(140.0);
  row.camera = perception::CameraModel::pinhole(900.0, 640.0), row.height_m = 1.2;
  return row;
}

DetectionRow radar_row() {
  DetectionRow row;
  row.unit = 1, row.facing_rad = from_deg(70.0);
  row.amplitude_0_db = -10.0, row.amplitude_1_db = 30.0;
  return row;
}

ros::Detection3D box_at(double x_m, double y_m, double score = 0.9) {
  ros::Detection3D box;
  box.results = {{.hypothesis = {.class_id = "car", .score = score}, .pose = {}}};
  box.bbox.center.position = {.x = x_m, .y = y_m, .z = 0.5};
  box.bbox.size = {.x = 4.9, .y = 1.9, .z = 1.2};
  return box;
}

template <class M, class Item>
DetectionFrame taken(const DetectionRow& row, std::vector<Item> M::*items, const Item& item,
                     std::uint64_t expected_bad = 0) {
  M message;
  message.header.frame_id = row.frame;
  message.*items = {item};
  DetectionFrame frame;
  std::uint64_t bad = 0;
  EXPECT_EQ(from_message(row, message, frame, bad), FrameVerdict::kTaken);
  EXPECT_EQ(bad, expected_bad);
  return frame;
}

DetectionFrame boxes_of(const ros::Detection3D& box, std::uint64_t bad = 0) {
  return taken(DetectionRow{}, &ros::Detection3DArray::detections, box, bad);
}

// Seen from above, an axis-angle of 30 degrees about z, and then one that pitches too.
TEST(DetectionCodec, ABoxHasItsPlaceItsYawAndItsSize) {
  ros::Detection3D box = box_at(12.0, -3.0, 0.75);
  const double half = 0.5 * from_deg(30.0), tilt = 0.5 * from_deg(10.0);
  box.bbox.center.orientation = {.z = std::sin(half), .w = std::cos(half)};
  Detection d = boxes_of(box).detections[0];
  EXPECT_EQ(d.x_m, 12.0);
  EXPECT_EQ(d.y_m, -3.0);
  EXPECT_NEAR(d.yaw_rad, from_deg(30.0), 1e-12);
  EXPECT_EQ(d.length_m, 4.9);
  EXPECT_EQ(d.width_m, 1.9);
  EXPECT_EQ(d.confidence, 0.75);
  EXPECT_TRUE(std::isnan(d.range_m) && std::isnan(d.bearing_rad) && std::isnan(d.range_rate_mps));
  // SciPy: Rotation.from_euler("ZY", [30, 10], degrees=True), a quaternion of any length.
  box.bbox.center.orientation = {.x = 2.0 * -std::sin(half) * std::sin(tilt),
                                 .y = 2.0 * std::cos(half) * std::sin(tilt),
                                 .z = 2.0 * std::sin(half) * std::cos(tilt),
                                 .w = 2.0 * std::cos(half) * std::cos(tilt)};
  EXPECT_NEAR(boxes_of(box).detections[0].yaw_rad, from_deg(30.0), 1e-12);
}

TEST(DetectionCodec, WhatABoxDoesNotSayIsUnset) {
  ros::Detection3D box = box_at(12.0, -3.0);
  box.bbox.size = {};
  box.bbox.center.orientation = {.w = 0.0};
  const Detection d = boxes_of(box).detections[0];
  EXPECT_TRUE(std::isnan(d.length_m) && std::isnan(d.width_m) && std::isnan(d.yaw_rad));
}

TEST(DetectionCodec, TheConfidenceIsTheLargestScore) {
  ros::Detection3D box = box_at(12.0, 0.0, 0.3);
  box.results.push_back({.hypothesis = {.class_id = "person", .score = 0.6}, .pose = {}});
  box.results.push_back({.hypothesis = {.class_id = "cone", .score = 0.1}, .pose = {}});
  EXPECT_EQ(boxes_of(box).detections[0].confidence, 0.6);
}

TEST(DetectionCodec, ABoxWithANumberThatCannotBeIsLeftOutAndCounted) {
  using Change = void (*)(ros::Detection3D&);
  for (const Change change : {
           Change{[](auto& b) { b.bbox.center.position.x = kNaN; }},
           Change{[](auto& b) { b.bbox.center.position.y = kInfinity; }},
           Change{[](auto& b) { b.bbox.center.orientation.w = kNaN; }},
           Change{[](auto& b) { b.bbox.size.x = -1.0; }},
           Change{[](auto& b) { b.bbox.size.y = kNaN; }},
           Change{[](auto& b) { b.results.clear(); }},
           Change{[](auto& b) { b.results[0].hypothesis.score = 1.5; }},
           Change{[](auto& b) { b.results[0].hypothesis.score = kNaN; }},
       }) {
    ros::Detection3D box = box_at(12.0, -3.0);
    change(box);
    EXPECT_TRUE(boxes_of(box, 1).detections.empty());
  }
  EXPECT_EQ(boxes_of(box_at(12.0, -3.0)).detections.size(), 1U);
}

// A car 30 m away and 20 degrees to the left of the axis, by similar triangles: 28.19 m along the
// axis, 10.26 m to the left of it.
TEST(DetectionCodec, AnImageHasABearingAndADepthByItsHeight) {
  const DetectionRow row = camera_row();
  const double along_m = 30.0 * std::cos(from_deg(20.0)), left_m = 30.0 * std::sin(from_deg(20.0));
  ros::Detection2D image;
  image.results = box_at(0.0, 0.0).results;
  image.bbox.center.position = {.x = 640.0 - 900.0 * left_m / along_m, .y = 400.0};
  image.bbox.size_x = 50.0, image.bbox.size_y = 900.0 * 1.2 / along_m;
  const DetectionFrame frame = taken(row, &ros::Detection2DArray::detections, image);
  EXPECT_EQ(frame.source, DetectionSource::kCamera);
  EXPECT_EQ(frame.unit, 3);
  EXPECT_NEAR(frame.detections[0].bearing_rad, from_deg(160.0), 1e-12);
  EXPECT_NEAR(1.0 / frame.detections[0].inverse_depth_per_m, 30.0, 1e-9);
  image.bbox.size_y = 0.0;
  const DetectionFrame flat = taken(row, &ros::Detection2DArray::detections, image);
  EXPECT_TRUE(std::isnan(flat.detections[0].inverse_depth_per_m));
  for (const double bad : {-1.0, kNaN, kInfinity}) {
    image.bbox.size_y = bad;
    EXPECT_TRUE(taken(row, &ros::Detection2DArray::detections, image, 1).detections.empty());
  }
}

TEST(DetectionCodec, AnImageIsReadByTheCalibrationOfItsCamera) {
  DetectionRow row = camera_row();
  row.camera = {1046.25, 1048.75, 1032.5, 471.25, {-0.302, 0.096, 0.0011, -0.0007, -0.0125}};
  const double along_m = 30.0 * std::cos(from_deg(20.0)), left_m = 30.0 * std::sin(from_deg(20.0));
  const auto at_height = [&](double below_axis_m) {
    return perception::project(row.camera, {-left_m / along_m, below_axis_m / along_m});
  };
  const perception::Pixel top = at_height(-0.6), bottom = at_height(0.6);
  ros::Detection2D image;
  image.results = box_at(0.0, 0.0).results;
  image.bbox.center.position = {0.5 * (top.u_px + bottom.u_px), 0.5 * (top.v_px + bottom.v_px)};
  image.bbox.size_x = 50.0, image.bbox.size_y = bottom.v_px - top.v_px;
  const Detection seen = taken(row, &ros::Detection2DArray::detections, image).detections[0];
  EXPECT_NEAR(seen.bearing_rad, from_deg(160.0), 1e-6);
  EXPECT_NEAR(1.0 / seen.inverse_depth_per_m, 30.0, 1e-3);
  // Without it both are wrong: 9 mrad, which are 0.27 m, and 4 %.
  row.camera.distortion = {};
  const Detection wrong = taken(row, &ros::Detection2DArray::detections, image).detections[0];
  EXPECT_GT(std::abs(wrong.bearing_rad - seen.bearing_rad), 0.005);
  EXPECT_GT(std::abs(seen.inverse_depth_per_m / wrong.inverse_depth_per_m - 1.0), 0.02);
}

TEST(DetectionCodec, APixelWithoutADirectionIsLeftOut) {
  DetectionRow row = camera_row();
  row.camera.distortion = {-0.5};
  ros::Detection2D image;
  image.results = box_at(0.0, 0.0).results;
  image.bbox.center.position = {.x = 640.0 + 0.56 * 900.0, .y = 0.0};
  EXPECT_TRUE(taken(row, &ros::Detection2DArray::detections, image, 1).detections.empty());
  image.bbox.center.position.x = 640.0 + 0.5 * 900.0;
  EXPECT_EQ(taken(row, &ros::Detection2DArray::detections, image).detections.size(), 1U);
}

TEST(DetectionCodec, AReturnIsSeenFromWhereTheRadarLooks) {
  const DetectionRow row = radar_row();
  const float azimuth = static_cast<float>(from_deg(-30.0));
  const ros::RadarReturn echo{.range = 40.0F,
                              .azimuth = azimuth,
                              .elevation = static_cast<float>(from_deg(60.0)),
                              .doppler_velocity = -7.5F,
                              .amplitude = 20.0F};
  const DetectionFrame frame = taken(row, &ros::RadarScan::returns, echo);
  EXPECT_EQ(frame.source, DetectionSource::kRadar);
  const Detection& d = frame.detections[0];
  EXPECT_NEAR(d.range_m, 20.0, 1e-5) << "on the ground";
  EXPECT_NEAR(d.bearing_rad, from_deg(40.0), 1e-6);
  EXPECT_EQ(d.range_rate_mps, -7.5);
  EXPECT_NEAR(d.confidence, 0.75, 1e-12);
  for (const float db : {-40.0F, 90.0F}) {
    ros::RadarReturn other = echo;
    other.amplitude = db;
    EXPECT_EQ(taken(row, &ros::RadarScan::returns, other).detections[0].confidence,
              db < 0.0F ? 0.0 : 1.0);
  }
  for (float ros::RadarReturn::*member :
       {&ros::RadarReturn::range, &ros::RadarReturn::azimuth, &ros::RadarReturn::elevation,
        &ros::RadarReturn::doppler_velocity, &ros::RadarReturn::amplitude}) {
    ros::RadarReturn other = echo;
    other.*member = std::numeric_limits<float>::quiet_NaN();
    EXPECT_TRUE(taken(row, &ros::RadarScan::returns, other, 1).detections.empty());
  }
  ros::RadarReturn here = echo;
  here.range = 0.0F;
  EXPECT_TRUE(taken(row, &ros::RadarScan::returns, here, 1).detections.empty());
}

TEST(DetectionCodec, AFrameOfAnotherPlaceOrWithTooManyIsRefusedAsAWhole) {
  ros::Detection3DArray message;
  message.header.frame_id = "base_link";
  message.detections.assign(world::kDetectionsMax, box_at(1.0, 2.0));
  DetectionFrame frame;
  std::uint64_t bad = 0;
  EXPECT_EQ(from_message({}, message, frame, bad), FrameVerdict::kTaken);
  EXPECT_EQ(frame.detections.size(), world::kDetectionsMax);
  message.detections.push_back(box_at(1.0, 2.0));
  EXPECT_EQ(from_message({}, message, frame, bad), FrameVerdict::kTooMany);
  message.detections.clear();
  EXPECT_EQ(from_message({}, message, frame, bad), FrameVerdict::kTaken) << "nothing was seen";
  EXPECT_TRUE(frame.detections.empty());
  message.header.frame_id = "map";
  EXPECT_EQ(from_message({}, message, frame, bad), FrameVerdict::kForeignFrame);
  EXPECT_EQ(bad, 0U);
}

bool is_same(double a, double b, double within) {
  return (std::isnan(a) && std::isnan(b)) || std::abs(a - b) <= within;
}

void expect_same(const Detection& a, const Detection& b, double within) {
  EXPECT_NEAR(a.confidence, b.confidence, within);
  EXPECT_TRUE(is_same(a.x_m, b.x_m, within) && is_same(a.y_m, b.y_m, within));
  EXPECT_TRUE(is_same(a.yaw_rad, b.yaw_rad, within)) << a.yaw_rad << ' ' << b.yaw_rad;
  EXPECT_TRUE(is_same(a.length_m, b.length_m, within) && is_same(a.width_m, b.width_m, within));
  EXPECT_TRUE(is_same(a.bearing_rad, b.bearing_rad, within)) << a.bearing_rad;
  EXPECT_TRUE(is_same(a.inverse_depth_per_m, b.inverse_depth_per_m, within));
  EXPECT_TRUE(is_same(a.range_m, b.range_m, within));
  EXPECT_TRUE(is_same(a.range_rate_mps, b.range_rate_mps, within));
}

// All that a sensor measures, over its view; a radar's message has floats.
TEST(DetectionCodec, AMessageOfAFrameGivesTheFrame) {
  constexpr double kDouble = 1e-12, kFloat = 2e-5;  // half an ulp of a float of 256 is 1.5e-5
  for (int i = -9; i <= 9; ++i) {
    const double angle_rad = from_deg(5.0 * i);
    DetectionFrame lidar, camera, radar, back;
    std::uint64_t bad = 0;
    lidar.source = DetectionSource::kLidar;
    ASSERT_TRUE(lidar.detections.push({.confidence = 0.05 * (i + 9),
                                       .x_m = 10.0 * i,
                                       .y_m = 3.0,
                                       .yaw_rad = 3.9 * angle_rad,
                                       .length_m = 5.0,
                                       .width_m = 2.0}));
    ASSERT_TRUE(lidar.detections.push({.confidence = 1.0, .x_m = 1.0, .y_m = 1.0}));
    EXPECT_EQ(from_message({}, box_message({}, lidar), back, bad), FrameVerdict::kTaken);
    ASSERT_EQ(back.detections.size(), 2U);
    for (std::size_t n : {0U, 1U}) expect_same(back.detections[n], lidar.detections[n], kDouble);

    camera.source = DetectionSource::kCamera;
    ASSERT_TRUE(camera.detections.push({.confidence = 0.5,
                                        .bearing_rad = wrap_pi(camera_row().facing_rad + angle_rad),
                                        .inverse_depth_per_m = 1.0 / (20.0 + i)}));
    EXPECT_EQ(from_message(camera_row(), image_message(camera_row(), camera), back, bad),
              FrameVerdict::kTaken);
    ASSERT_EQ(back.detections.size(), 1U);
    expect_same(back.detections[0], camera.detections[0], kDouble);

    radar.source = DetectionSource::kRadar;
    ASSERT_TRUE(radar.detections.push({.confidence = 0.5,
                                       .bearing_rad = wrap_pi(radar_row().facing_rad + angle_rad),
                                       .range_m = 160.0 + i,
                                       .range_rate_mps = -80.0}));
    EXPECT_EQ(from_message(radar_row(), radar_message(radar_row(), radar), back, bad),
              FrameVerdict::kTaken);
    ASSERT_EQ(back.detections.size(), 1U);
    expect_same(back.detections[0], radar.detections[0], kFloat);
    EXPECT_EQ(bad, 0U);
  }
}

}  // namespace
}  // namespace pitwall::io
