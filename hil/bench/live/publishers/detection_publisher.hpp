// Simulated detections of the other cars for a car that reads them over ROS 2 topics: the sensors
// of lockstep (hil/sensors/detections.hpp), with their latency and order, behind the topics of the
// car's sensor file.
//   in     the sensor file; the true cars, at every step of the rig
//   out    messages on the topics of the rows that detect cars, dated by the time of measurement in
//          UTC. A row gets the sensor of its kind and unit
//   errors open(): Problem of a row without a simulated sensor, or of DDS; later sent() and lost()
//   cost   a DDS write for each frame: not for the car's loop
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "hil/faults/perception_faults.hpp"
#include "hil/sensors/detections.hpp"
#include "protocol/dds/domain.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"
#include "vehicle/io/ingress/sensor_file.hpp"

namespace pitwall::bench {

class DetectionPublisher {
 public:
  // Sensors and `seed` are those of the scenario: the draws are those of lockstep.
  static Result<DetectionPublisher, Problem> open(const io::SensorFile& file,
                                                  const sensors::DetectionSensors& simulated,
                                                  std::span<const faults::BenchFault> faults,
                                                  std::uint64_t seed);

  // `at` is scenario time, `started` the time of this process at its zero.
  void step(const sensors::TrueCars& cars, Instant at, Instant started);
  // Frames for a reader that is connected.
  std::uint64_t sent() const { return sent_; }
  // Frames that DDS did not accept, or that found no room in the simulated sensors.
  std::uint64_t lost() const { return refused_ + state_.overflows; }

 private:
  struct Topic {
    io::SensorRow row;
    dds::Writer* writer;
  };
  DetectionPublisher(std::unique_ptr<dds::Domain> domain, std::vector<Topic> topics,
                     const sensors::DetectionSensors& sensors,
                     std::span<const faults::BenchFault> faults, std::uint64_t seed);
  void publish(const Topic& topic, const world::DetectionFrame& frame, UtcTime at);

  std::unique_ptr<dds::Domain> domain_;
  std::vector<Topic> topics_;
  sensors::DetectionSensors sensors_;
  std::vector<faults::BenchFault> faults_;
  sensors::DetectionState state_;
  sensors::Arrivals arrivals_;
  std::vector<std::uint8_t> bytes_;  // of a message; kept for its storage
  std::uint64_t sent_ = 0, refused_ = 0;
};

}  // namespace pitwall::bench
