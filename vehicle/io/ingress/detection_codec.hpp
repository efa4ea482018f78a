// Conversion of detections of other cars between ROS 2 messages and the frames of tracking: from a
// message in the car, to a message in the bench.
//
//     vision_msgs/Detection3DArray  kLidar   bbox.center and size (x: length, y: width)
//     vision_msgs/Detection2DArray  kCamera  bbox: middle and height in pixels
//     radar_msgs/RadarScan          kRadar   range, azimuth, elevation, doppler_velocity, amplitude
//
//   in     message and DetectionRow; or frame and row
//   out    frame without `at` and `received`; or the message without header.stamp
//   frames header.frame_id must be that of the row; the frame itself is the car's base_link: ISO
//          8855, at the centre of gravity. Heights are not used. Camera and radar look along
//          facing_rad and measure from its origin
//   camera bearing = facing + off, off = atan(-x) of the direction to the box's middle, x to the
//          right: left is positive. Inverse depth = h cos(off) / height_m with the height h of the
//          box at depth 1. Without a calibration x = (u - centre_px) / focal_px and h is the
//          height in pixels by focal_px
//   radar  range rate = doppler_velocity, positive while the distance grows, with our own motion in
//          it. Confidence: linear in the amplitude, from 0 at amplitude_0_db to 1 at amplitude_1_db
//   unset  a box without a size, or with a quaternion of zeros: not measured; likewise an image
//          without a height
//   not read
//          covariances (the car file has the noise of each sensor: tracking.road), classes, ids.
//          The confidence is the largest score of the hypotheses
//   errors from_message(): a frame is refused for another frame_id or more than kDetectionsMax
//          detections; a detection is left out and counted if a number is no number or cannot be
//   source pinhole: Hartley and Zisserman, Multiple View Geometry (2004), section 6.1; yaw of a
//          quaternion: Diebel (2006), equation 290
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "protocol/ros/messages/radar.hpp"
#include "protocol/ros/messages/vision.hpp"
#include "vehicle/io/ingress/sensor_file.hpp"
#include "vehicle/world/detection.hpp"

namespace pitwall::io {

enum class FrameVerdict : std::uint8_t { kTaken, kForeignFrame, kTooMany };

// Fills source, unit and detections of `frame`; adds to `bad` for each detection that is left out.
FrameVerdict from_message(const DetectionRow& row, const ros::Detection3DArray& message,
                          world::DetectionFrame& frame, std::uint64_t& bad);
FrameVerdict from_message(const DetectionRow& row, const ros::Detection2DArray& message,
                          world::DetectionFrame& frame, std::uint64_t& bad);
FrameVerdict from_message(const DetectionRow& row, const ros::RadarScan& message,
                          world::DetectionFrame& frame, std::uint64_t& bad);

// The frame has the source of the message.
ros::Detection3DArray box_message(const DetectionRow& row, const world::DetectionFrame& frame);
ros::Detection2DArray image_message(const DetectionRow& row, const world::DetectionFrame& frame);
ros::RadarScan radar_message(const DetectionRow& row, const world::DetectionFrame& frame);

}  // namespace pitwall::io
