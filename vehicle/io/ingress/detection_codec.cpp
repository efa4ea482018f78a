// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/ingress/detection_codec.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numbers>
#include <optional>

#include "protocol/vocabulary/check.hpp"

namespace pitwall::io {
namespace {

using world::Detection, world::DetectionFrame, world::DetectionSource;

constexpr double kNoTurn = 1e-6;  // square of the norm of a quaternion that says nothing

bool are_finite(std::initializer_list<double> values) {
  return std::ranges::all_of(values, [](double v) { return std::isfinite(v); });
}

// Unset without a hypothesis, or with one that is no share.
double confidence_of(const std::vector<ros::ObjectHypothesisWithPose>& results) {
  double most = kUnset;
  for (const ros::ObjectHypothesisWithPose& result : results) {
    const double score = result.hypothesis.score;
    if (!(score >= 0.0 && score <= 1.0)) return kUnset;
    most = std::fmax(most, score);
  }
  return most;
}

double set_if_positive(double v) { return v > 0.0 ? v : kUnset; }

double yaw_of(const ros::Quaternion& q) {
  const double norm = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
  if (norm < kNoTurn) return kUnset;
  return std::atan2(2.0 * (q.w * q.z + q.x * q.y), q.w * q.w + q.x * q.x - q.y * q.y - q.z * q.z);
}

std::optional<Detection> detection_of(const DetectionRow&, const ros::Detection3D& m) {
  const ros::Point& centre = m.bbox.center.position;
  const ros::Quaternion& turn = m.bbox.center.orientation;
  const ros::Vector3& size = m.bbox.size;
  if (!are_finite({centre.x, centre.y, turn.x, turn.y, turn.z, turn.w, size.x, size.y}))
    return std::nullopt;
  if (size.x < 0.0 || size.y < 0.0) return std::nullopt;
  Detection d;
  d.confidence = confidence_of(m.results);
  d.x_m = centre.x, d.y_m = centre.y, d.yaw_rad = yaw_of(turn);
  d.length_m = set_if_positive(size.x), d.width_m = set_if_positive(size.y);
  return d;
}

std::optional<Detection> detection_of(const DetectionRow& row, const ros::Detection2D& m) {
  const double u_px = m.bbox.center.position.x, v_px = m.bbox.center.position.y;
  const double height_px = m.bbox.size_y;
  if (!are_finite({u_px, v_px, height_px}) || height_px < 0.0) return std::nullopt;
  const auto upper = perception::undistort(row.camera, {u_px, v_px - 0.5 * height_px});
  const auto lower = perception::undistort(row.camera, {u_px, v_px + 0.5 * height_px});
  if (!upper || !lower) return std::nullopt;
  const double off_axis_rad = std::atan(-0.5 * (upper->x + lower->x));
  Detection d;
  d.confidence = confidence_of(m.results);
  d.bearing_rad = wrap_pi(row.facing_rad + off_axis_rad);
  d.inverse_depth_per_m =
      set_if_positive((lower->y - upper->y) * std::cos(off_axis_rad) / row.height_m);
  return d;
}

std::optional<Detection> detection_of(const DetectionRow& row, const ros::RadarReturn& m) {
  constexpr double kTurn_rad = 2.0 * std::numbers::pi;
  const double range_m = m.range, azimuth_rad = m.azimuth, elevation_rad = m.elevation;
  if (!are_finite({range_m, azimuth_rad, elevation_rad, m.doppler_velocity, m.amplitude}))
    return std::nullopt;
  if (!(range_m > 0.0) || std::abs(azimuth_rad) > kTurn_rad ||
      std::abs(elevation_rad) > 0.5 * std::numbers::pi)
    return std::nullopt;
  Detection d;
  d.confidence = std::clamp(
      (m.amplitude - row.amplitude_0_db) / (row.amplitude_1_db - row.amplitude_0_db), 0.0, 1.0);
  d.range_m = range_m * std::cos(elevation_rad);
  d.bearing_rad = wrap_pi(row.facing_rad + azimuth_rad);
  d.range_rate_mps = m.doppler_velocity;
  return d;
}

template <class Items>
FrameVerdict fill(DetectionSource source, const DetectionRow& row, const ros::Header& header,
                  const Items& items, DetectionFrame& frame, std::uint64_t& bad) {
  if (header.frame_id != row.frame) return FrameVerdict::kForeignFrame;
  if (items.size() > world::kDetectionsMax) return FrameVerdict::kTooMany;
  frame.source = source, frame.unit = row.unit;
  frame.detections.clear();
  for (const auto& item : items) {
    const std::optional<Detection> d = detection_of(row, item);
    if (d && !std::isnan(d->confidence))
      CHECK(frame.detections.push(*d));
    else
      ++bad;
  }
  return FrameVerdict::kTaken;
}

double or_zero(double v) { return std::isnan(v) ? 0.0 : v; }

std::vector<ros::ObjectHypothesisWithPose> hypothesis_of(const Detection& d) {
  return {{.hypothesis = {.class_id = "car", .score = d.confidence}, .pose = {}}};
}

}  // namespace

FrameVerdict from_message(const DetectionRow& row, const ros::Detection3DArray& message,
                          DetectionFrame& frame, std::uint64_t& bad) {
  return fill(DetectionSource::kLidar, row, message.header, message.detections, frame, bad);
}

FrameVerdict from_message(const DetectionRow& row, const ros::Detection2DArray& message,
                          DetectionFrame& frame, std::uint64_t& bad) {
  return fill(DetectionSource::kCamera, row, message.header, message.detections, frame, bad);
}

FrameVerdict from_message(const DetectionRow& row, const ros::RadarScan& message,
                          DetectionFrame& frame, std::uint64_t& bad) {
  return fill(DetectionSource::kRadar, row, message.header, message.returns, frame, bad);
}

ros::Detection3DArray box_message(const DetectionRow& row, const DetectionFrame& frame) {
  CHECK(frame.source == DetectionSource::kLidar);
  ros::Detection3DArray message;
  message.header.frame_id = row.frame;
  for (const Detection& d : frame.detections) {
    ros::Detection3D& out = message.detections.emplace_back();
    out.results = hypothesis_of(d);
    out.bbox.center.position = {.x = d.x_m, .y = d.y_m};
    const double half_rad = 0.5 * d.yaw_rad;
    out.bbox.center.orientation =
        std::isnan(half_rad) ? ros::Quaternion{.w = 0.0}
                             : ros::Quaternion{.z = std::sin(half_rad), .w = std::cos(half_rad)};
    out.bbox.size = {.x = or_zero(d.length_m), .y = or_zero(d.width_m)};
  }
  return message;
}

ros::Detection2DArray image_message(const DetectionRow& row, const DetectionFrame& frame) {
  CHECK(frame.source == DetectionSource::kCamera);
  ros::Detection2DArray message;
  message.header.frame_id = row.frame;
  for (const Detection& d : frame.detections) {
    const double off_axis_rad = wrap_pi(d.bearing_rad - row.facing_rad);
    ros::Detection2D& out = message.detections.emplace_back();
    out.results = hypothesis_of(d);
    const double x = -std::tan(off_axis_rad);
    const double half =
        0.5 * or_zero(d.inverse_depth_per_m) * row.height_m / std::cos(off_axis_rad);
    const perception::Pixel upper = perception::project(row.camera, {x, -half});
    const perception::Pixel lower = perception::project(row.camera, {x, half});
    out.bbox.center.position = {0.5 * (upper.u_px + lower.u_px), 0.5 * (upper.v_px + lower.v_px)};
    out.bbox.size_y = lower.v_px - upper.v_px;
  }
  return message;
}

ros::RadarScan radar_message(const DetectionRow& row, const DetectionFrame& frame) {
  CHECK(frame.source == DetectionSource::kRadar);
  ros::RadarScan message;
  message.header.frame_id = row.frame;
  for (const Detection& d : frame.detections) {
    const double db = row.amplitude_0_db + d.confidence * (row.amplitude_1_db - row.amplitude_0_db);
    message.returns.push_back(
        {.range = static_cast<float>(d.range_m),
         .azimuth = static_cast<float>(wrap_pi(d.bearing_rad - row.facing_rad)),
         .elevation = 0.0F,
         .doppler_velocity = static_cast<float>(d.range_rate_mps),
         .amplitude = static_cast<float>(db)});
  }
  return message;
}

}  // namespace pitwall::io
