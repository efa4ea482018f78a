// Input of ROS 2 sensor topics: for perception the newest sample of each sensor, for tracking the
// detections of other cars, with statistics of their arrival.
//   in     topics of a sensor file, over DDS
//   out    newest sample of each sensor by type; every frame of detections, in order of arrival;
//          rate, gap, latency, drops, refusals
//   invariants
//          each sensor has its own DDS participant with its own sockets and threads, so that none
//          waits for another. No part of them runs in the 100 Hz loop, which takes from mailboxes
//          and atomic figures without waiting
//          a message that is not whole and well-formed is refused, counted, and not delivered
//   units  latency: from header.stamp to arrival, both in UTC
//   errors start(): Problem with the sensor. Later: counters
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "protocol/ros/messages/sensor.hpp"
#include "vehicle/io/ingress/arrivals.hpp"
#include "vehicle/io/ingress/detection_inbox.hpp"
#include "vehicle/io/ingress/mailbox.hpp"
#include "vehicle/io/ingress/sensor_file.hpp"
#include "vehicle/world/detection.hpp"

namespace pitwall::io {

struct SensorCounts {
  std::uint64_t samples = 0;
  std::uint64_t foreign_types = 0;  // writers of the topic with another type
  std::uint64_t overwritten = 0;    // not taken before the next one
  std::uint64_t refused = 0;        // truncated, not CDR, or inconsistent sizes
  std::uint64_t bad_stamps = 0;     // more than kStampApart from this clock
  DetectionCounts detections{};     // instead of the last three, of a sensor that detects cars
};

// Returns nullptr if the sizes in the message are consistent, else the contradiction.
const char* contradiction_of(const ros::PointCloud2& cloud);
const char* contradiction_of(const ros::Image& image);
const char* contradiction_of(const ros::CompressedImage& image);
const char* contradiction_of(const ros::NavSatFix& fix);
const char* contradiction_of(const ros::Imu& imu);

class SensorIngress {
 public:
  static constexpr Duration kStampApart = seconds(10);
  static constexpr std::size_t kFramesMost = 64;  // of detections, in one tick

  static Result<std::unique_ptr<SensorIngress>, Problem> start(const SensorFile& file);
  ~SensorIngress();

  std::size_t size() const { return sensors_.size(); }
  const SensorRow& row(std::size_t i) const;
  ArrivalFigures figures(std::size_t i, Instant now) const;
  // Of the sensor that is this unit of a type, in the order of the rows or, if it detects cars, by
  // its own number; of kDetection2DArray also a camera whose images the car looks at. No
  // allocation, no lock.
  std::optional<SensorFigures> figures(SensorType type, std::size_t unit, Instant now) const;
  SensorCounts counts(std::size_t i) const;
  // The newest sample that was not taken yet; nullptr if there is none or the sensor has another
  // type.
  template <class M>
  const M* take(std::size_t i);
  // All frames of detections since the last call, at most kFramesMost; what is left comes with the
  // next call. Valid until then. No allocation.
  std::span<const world::DetectionFrame> take_detections();
  // A list for the summary of a run; `more`: more rows of it.
  std::string json(Instant now, std::span<const std::string> more = {}) const;

  struct Sensor;

 private:
  SensorIngress();
  Instant started_;
  std::vector<std::unique_ptr<Sensor>> sensors_;
  std::vector<world::DetectionFrame> frames_;  // of this tick
};

}  // namespace pitwall::io
