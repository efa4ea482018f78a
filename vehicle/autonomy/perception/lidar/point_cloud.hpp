// Points that LiDARs measured.
//   frames Body of our car at the time of the measurement (ISO 8855: x forward, y left, z up), or
//          that of the sensor where a file has no other
//   units  in the names; intensity as the sensor gives it, without a unit
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace pitwall::perception {

struct LidarPoint {
  float x_m = 0.0F, y_m = 0.0F, z_m = 0.0F;
  float intensity = 0.0F;
};

using PointCloud = std::vector<LidarPoint>;

}  // namespace pitwall::perception
