// Perception faults of a scenario, applied to the sensors that see other cars.
//   in     faults, now
//   out    what ails each sensor: of several, added latencies and false detections add up
//   law    a LiDAR that is out hides its third of the surroundings from the detector behind all
//          three
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "hil/faults/bench_fault.hpp"
#include "hil/sensors/detections.hpp"

namespace pitwall::faults {

bool is_perception_fault(BenchFaultKind kind);
// Number of equal units that `unit` of such a fault selects from; 1: no choice.
std::size_t perception_units_of(BenchFaultKind kind);
// True if the model accepts this value.
bool is_perception_value(BenchFaultKind kind, double value);

void apply_perception_faults(std::span<const BenchFault> faults, Instant now,
                             const sensors::DetectionSensors& sensors,
                             sensors::DetectionState& state);

// Of LiDARs whose sweeps are there.
struct LidarFault {
  std::array<bool, sensors::kLidarUnits> outage{};
  Duration added_latency{};
};
LidarFault lidar_fault(std::span<const BenchFault> faults, Instant now);

// Of cameras whose images are there.
struct CameraFault {
  std::array<bool, sensors::kCameraUnits> outage{};
};
CameraFault camera_fault(std::span<const BenchFault> faults, Instant now);

}  // namespace pitwall::faults
