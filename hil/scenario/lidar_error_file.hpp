// Files of the errors of a LiDAR detector, as `./pitwall bench perception --errors` writes them:
//
//     detector: pillar network
//     false_per_sweep: 0.01
//     ranges:
//       - {from_m: 0, to_m: 20, found: 0.98, position_rms_m: 0.12, yaw_rms_deg: 1.5}
//
//   errors Problem with file, line and column: a key that is missing or unknown, a number that
//          cannot be, ranges that leave a gap or overlap
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "hil/sensors/detection_params.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::scenario {

// Of the network that the car has.
inline constexpr const char* kLidarErrorFile = "hil/config/sensors/lidar_pillars.yaml";

Result<sensors::DetectorErrors, Problem> read_lidar_errors(std::string_view text,
                                                           const std::string& name);

}  // namespace pitwall::scenario
