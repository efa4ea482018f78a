// Rate, gap and latency checks of the sensors. In the paper, under load, the LiDAR came at 5 Hz
// instead of 20 with gaps above half a second, although each frame was recent.
//   in     rate, largest gap and latency of each sensor as the car reports them
//   out    rate as a share of the nominal one, largest gap, latency as a share of the allowed one;
//          of one sensor, or the worst of all
//   invariants
//          a sensor that was never received is not judged: this car does not have it. One that was
//          received and is silent now has the rate 0
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

#include "basestation/state/vehicle_state.hpp"
#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::state {

// `latency_allowed_ms`: of the largest one within a second, as the car reports it.
struct SensorRow {
  std::string_view name;
  telemetry::FieldIndex rate, gap, latency;
  double nominal_hz, latency_allowed_ms;
};
consteval SensorRow sensor_row(std::string_view name, double nominal_hz,
                               double latency_allowed_ms) {
  const std::string path = "sensors." + std::string{name};
  return {name,
          telemetry::field(path + "_rate"),
          telemetry::field(path + "_gap"),
          telemetry::field(path + "_latency"),
          nominal_hz,
          latency_allowed_ms};
}
inline constexpr auto kSensorTable = std::to_array<SensorRow>({
    sensor_row("gnss0", 20.0, 100.0),
    sensor_row("gnss1", 20.0, 100.0),
    sensor_row("imu0", 125.0, 30.0),
    sensor_row("imu1", 125.0, 30.0),
    sensor_row("lidar", 20.0, 150.0),
    sensor_row("lidar0", 20.0, 105.0),
    sensor_row("lidar1", 20.0, 105.0),
    sensor_row("lidar2", 20.0, 105.0),
    sensor_row("camera0", 10.0, 150.0),  // images; detections come oftener
    sensor_row("camera1", 10.0, 150.0),
    sensor_row("radar", 15.0, 150.0),
});
inline constexpr std::size_t kSensors = kSensorTable.size();

struct SensorHealth {
  double rate_share = kUnset, gap_ms = kUnset, latency_share = kUnset;
};
SensorHealth health_of(const SensorRow& row, const VehicleState& vehicle, Instant now);
SensorHealth worst_sensor(const VehicleState& vehicle, Instant now);

// How far what a camera sees is off, as a share of what is allowed: bearing, distance, of any
// camera. Above 1 its calibration is in doubt.
inline constexpr double kCameraBearingAllowed_rad = 0.005, kCameraDistanceAllowed = 0.15;
double worst_camera_offset(const VehicleState& vehicle, Instant now);

}  // namespace pitwall::state
