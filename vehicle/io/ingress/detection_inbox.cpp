// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/ingress/detection_inbox.hpp"

#include "protocol/ros/cdr.hpp"
#include "protocol/vocabulary/check.hpp"
#include "vehicle/io/ingress/detection_codec.hpp"
#include "vehicle/io/ingress/stamp.hpp"

namespace pitwall::io {

template <class M>
std::optional<Duration> DetectionInbox::receive_as(std::span<const std::uint8_t> cdr, UtcTime utc,
                                                   Instant now) {
  const auto refuse = [](Count& count) {
    ++count;
    return std::nullopt;
  };
  const auto message = ros::decode<M>(cdr);
  if (!message) return refuse(refused_);
  const Duration age = age_of(message->header, utc);
  if (-age > kAheadMost) return refuse(in_future_);
  if (age > kOldest) return refuse(too_old_);
  world::DetectionFrame frame{.at = now - age, .received = now};
  std::uint64_t bad = 0;
  const FrameVerdict verdict = from_message(row_, *message, frame, bad);
  if (verdict == FrameVerdict::kForeignFrame) return refuse(foreign_frames_);
  if (verdict == FrameVerdict::kTooMany) return refuse(too_many_);
  bad_detections_ += bad;
  if (!queue_.push(frame)) return refuse(no_room_);
  ++taken_;
  return age;
}

std::optional<Duration> DetectionInbox::receive(std::span<const std::uint8_t> cdr, UtcTime utc,
                                                Instant now) {
  switch (type_) {
    case SensorType::kDetection3DArray:
      return receive_as<ros::Detection3DArray>(cdr, utc, now);
    case SensorType::kDetection2DArray:
      return receive_as<ros::Detection2DArray>(cdr, utc, now);
    case SensorType::kRadarScan:
      return receive_as<ros::RadarScan>(cdr, utc, now);
    default:
      CHECK(false);
  }
}

DetectionCounts DetectionInbox::counts() const {
  return {.taken = taken_,
          .refused = refused_,
          .in_future = in_future_,
          .too_old = too_old_,
          .foreign_frames = foreign_frames_,
          .too_many = too_many_,
          .no_room = no_room_,
          .bad_detections = bad_detections_};
}

}  // namespace pitwall::io
