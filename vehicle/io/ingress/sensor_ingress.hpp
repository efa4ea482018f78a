// Input of ROS 2 sensor topics for perception: the newest sample of each sensor, with statistics of
// its arrival.
//   in     topics of a sensor file, over DDS
//   out    newest sample of each sensor by type; rate, gap, latency, drops, refusals
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
#include <string>
#include <variant>
#include <vector>

#include "protocol/ros/messages/sensor.hpp"
#include "vehicle/io/ingress/arrivals.hpp"
#include "vehicle/io/ingress/mailbox.hpp"
#include "vehicle/io/ingress/sensor_file.hpp"

namespace pitwall::io {

struct SensorCounts {
  std::uint64_t samples = 0;
  std::uint64_t overwritten = 0;    // not taken before the next one
  std::uint64_t refused = 0;        // truncated, not CDR, or inconsistent sizes
  std::uint64_t foreign_types = 0;  // writers of the topic with another type
  std::uint64_t bad_stamps = 0;     // more than kStampApart from this clock
};

// Returns nullptr if the sizes in the message are consistent, else the contradiction.
const char* contradiction_of(const ros::PointCloud2& cloud);
const char* contradiction_of(const ros::Image& image);
const char* contradiction_of(const ros::NavSatFix& fix);
const char* contradiction_of(const ros::Imu& imu);

class SensorIngress {
 public:
  static constexpr Duration kStampApart = seconds(10);

  static Result<std::unique_ptr<SensorIngress>, Problem> start(const SensorFile& file);
  ~SensorIngress();

  std::size_t size() const { return sensors_.size(); }
  const SensorRow& row(std::size_t i) const;
  ArrivalFigures figures(std::size_t i, Instant now) const;
  // Figures of the sensor with this name; unset if there is none.
  ArrivalFigures figures(const std::string& name, Instant now) const;
  SensorCounts counts(std::size_t i) const;
  // The newest sample that was not taken yet; nullptr if there is none or the sensor has another
  // type.
  template <class M>
  const M* take(std::size_t i);
  std::string json(Instant now) const;  // a list, for the summary of a run

  struct Sensor;

 private:
  SensorIngress() = default;
  std::vector<std::unique_ptr<Sensor>> sensors_;
};

}  // namespace pitwall::io
