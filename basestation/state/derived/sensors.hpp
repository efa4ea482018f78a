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
#include <string_view>

#include "basestation/state/vehicle_state.hpp"
#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::state {

struct SensorRow {
  std::string_view name;
  telemetry::FieldIndex rate, gap, latency;
  double nominal_hz, latency_allowed_ms;
};
inline constexpr auto kSensorTable = std::to_array<SensorRow>({
    {"gnss0", telemetry::field("sensors.gnss0_rate"), telemetry::field("sensors.gnss0_gap"),
     telemetry::field("sensors.gnss0_latency"), 20.0, 100.0},
    {"gnss1", telemetry::field("sensors.gnss1_rate"), telemetry::field("sensors.gnss1_gap"),
     telemetry::field("sensors.gnss1_latency"), 20.0, 100.0},
    {"imu0", telemetry::field("sensors.imu0_rate"), telemetry::field("sensors.imu0_gap"),
     telemetry::field("sensors.imu0_latency"), 125.0, 30.0},
    {"imu1", telemetry::field("sensors.imu1_rate"), telemetry::field("sensors.imu1_gap"),
     telemetry::field("sensors.imu1_latency"), 125.0, 30.0},
    {"lidar", telemetry::field("sensors.lidar_rate"), telemetry::field("sensors.lidar_gap"),
     telemetry::field("sensors.lidar_latency"), 20.0, 105.0},
    {"camera", telemetry::field("sensors.camera_rate"), telemetry::field("sensors.camera_gap"),
     telemetry::field("sensors.camera_latency"), 20.0, 150.0},
    {"radar", telemetry::field("sensors.radar_rate"), telemetry::field("sensors.radar_gap"),
     telemetry::field("sensors.radar_latency"), 15.0, 150.0},
});
inline constexpr std::size_t kSensors = kSensorTable.size();

struct SensorHealth {
  double rate_share = kUnset, gap_ms = kUnset, latency_share = kUnset;
};
SensorHealth health_of(const SensorRow& row, const VehicleState& vehicle, Instant now);
SensorHealth worst_sensor(const VehicleState& vehicle, Instant now);

}  // namespace pitwall::state
