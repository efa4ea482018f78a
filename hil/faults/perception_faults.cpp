// SPDX-License-Identifier: Apache-2.0
#include "hil/faults/perception_faults.hpp"

#include <algorithm>

#include "protocol/vocabulary/check.hpp"

namespace pitwall::faults {
namespace {

using enum BenchFaultKind;
using world::DetectionSource;

bool is_about(BenchFaultKind kind, DetectionSource source) {
  switch (kind) {
    case kCameraOutage:
      return source == DetectionSource::kCamera;
    case kRadarOutage:
      return source == DetectionSource::kRadar;
    default:
      return source == DetectionSource::kLidar;
  }
}

void spoil(const BenchFault& fault, std::uint8_t unit, sensors::DetectionFault& f) {
  switch (fault.kind) {
    case kLidarOutage:
      if (std::ranges::count(f.blind, sensors::lidar_sector(fault.unit)) == 0)
        CHECK(f.blind.push(sensors::lidar_sector(fault.unit)));
      return;
    case kLidarLate:
      f.added_latency = f.added_latency + from_seconds(fault.value);
      return;
    case kDust:
      f.false_per_s += fault.value;
      return;
    default:
      f.outage |= fault.unit == unit;
  }
}

}  // namespace

bool is_perception_fault(BenchFaultKind kind) {
  return row_of(kind).acts_on == BenchPart::kPerception;
}

std::size_t perception_units_of(BenchFaultKind kind) {
  switch (kind) {
    case kLidarOutage:
      return sensors::kLidarUnits;
    case kCameraOutage:
      return sensors::kCameraUnits;
    case kRadarOutage:
      return sensors::kRadarUnits;
    default:
      return 1;
  }
}

bool is_perception_value(BenchFaultKind kind, double value) {
  constexpr double kFalseMost_per_s = 200.0;  // ten in every frame
  if (kind == kLidarLate) return value > 0.0 && value <= sensors::kDetectionLateMost.seconds();
  return value > 0.0 && value <= kFalseMost_per_s;
}

void apply_perception_faults(std::span<const BenchFault> faults, Instant now,
                             const sensors::DetectionSensors& sensors,
                             sensors::DetectionState& state) {
  CHECK(sensors.size() == state.sensor.size());
  if (faults.empty()) return;  // as in every run but a few, at each step
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    sensors::DetectionFault& f = state.sensor[i].fault;
    f = {};
    for (const BenchFault& fault : faults)
      if (active(fault, now) && is_about(fault.kind, sensors[i].source))
        spoil(fault, sensors[i].unit, f);
    if (f.added_latency > sensors::kDetectionLateMost)
      f.added_latency = sensors::kDetectionLateMost;
  }
}

LidarFault lidar_fault(std::span<const BenchFault> faults, Instant now) {
  LidarFault f;
  for (const BenchFault& fault : faults) {
    if (!active(fault, now)) continue;
    if (fault.kind == kLidarOutage) f.outage[fault.unit] = true;
    if (fault.kind == kLidarLate) f.added_latency = f.added_latency + from_seconds(fault.value);
  }
  return f;
}

CameraFault camera_fault(std::span<const BenchFault> faults, Instant now) {
  CameraFault f;
  for (const BenchFault& fault : faults)
    if (fault.kind == kCameraOutage && active(fault, now)) f.outage[fault.unit] = true;
  return f;
}

}  // namespace pitwall::faults
