// Configuration file of the sensors that are received over ROS 2 topics:
//
//     domain: 0                       # ROS_DOMAIN_ID
//     interface: 192.168.10.5         # of this machine; default 127.0.0.1
//     peers: [192.168.10.7]           # optional; hosts that multicast does not reach
//     sensors:
//       - {name: lidar, topic: /luminar_front/points, type: PointCloud2, rate_hz: 20}
//
//   invariants
//          names and topics are unique; telemetry reports `lidar`, `camera` and `radar` to the pit
//          wall
//   errors Problem with file, line and column
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "protocol/dds/domain.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::io {

enum class SensorType : std::uint8_t { kPointCloud2, kImage, kNavSatFix, kImu };

struct SensorRow {
  std::string name, topic;
  SensorType type = SensorType::kPointCloud2;
  double rate_hz = 0.0;  // expected rate
};

struct SensorFile {
  dds::DomainConfig domain;
  std::vector<SensorRow> sensors;
};

inline constexpr std::size_t kSensorsMax = 16;

Result<SensorFile, Problem> read_sensor_file(const std::string& path);

}  // namespace pitwall::io
