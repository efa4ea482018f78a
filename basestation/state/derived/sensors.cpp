// SPDX-License-Identifier: Apache-2.0
#include "basestation/state/derived/sensors.hpp"

#include <cmath>

namespace pitwall::state {

SensorHealth health_of(const SensorRow& row, const VehicleState& vehicle, Instant now) {
  const double rate_hz = vehicle.view(row.rate, now).value;
  if (std::isnan(rate_hz)) return {};
  return {.rate_share = rate_hz / row.nominal_hz,
          .gap_ms = vehicle.view(row.gap, now).value,
          .latency_share = vehicle.view(row.latency, now).value / row.latency_allowed_ms};
}

SensorHealth worst_sensor(const VehicleState& vehicle, Instant now) {
  SensorHealth worst;
  for (const SensorRow& row : kSensorTable) {
    const SensorHealth one = health_of(row, vehicle, now);
    worst.rate_share = std::fmin(worst.rate_share, one.rate_share);  // of what is known
    worst.gap_ms = std::fmax(worst.gap_ms, one.gap_ms);
    worst.latency_share = std::fmax(worst.latency_share, one.latency_share);
  }
  return worst;
}

double worst_camera_offset(const VehicleState& vehicle, Instant now) {
  constexpr std::array kBearings{telemetry::field("sensors.camera0_bearing_bias"),
                                 telemetry::field("sensors.camera1_bearing_bias")};
  constexpr std::array kRatios{telemetry::field("sensors.camera0_distance_ratio"),
                               telemetry::field("sensors.camera1_distance_ratio")};
  double worst = kUnset;
  for (const telemetry::FieldIndex bearing : kBearings)
    worst =
        std::fmax(worst, std::abs(vehicle.view(bearing, now).value) / kCameraBearingAllowed_rad);
  for (const telemetry::FieldIndex ratio : kRatios)
    worst =
        std::fmax(worst, std::abs(vehicle.view(ratio, now).value - 1.0) / kCameraDistanceAllowed);
  return worst;
}

}  // namespace pitwall::state
