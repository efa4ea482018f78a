// Points that LiDARs measured.
//   frames Body of our car at the time of the measurement (ISO 8855: x forward, y left, z up), or
//          that of the sensor
//   units  in the names; intensity as the sensor gives it, without a unit
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <vector>

namespace pitwall::perception {

struct LidarPoint {
  float x_m = 0.0F, y_m = 0.0F, z_m = 0.0F;
  float intensity = 0.0F;
  float after_s = 0.0F;  // of its ray: since the sweep began, in a merged cloud since its
                         // reference time; 0 where that is not known
};

inline bool is_finite(const LidarPoint& p) {
  return std::isfinite(p.x_m) && std::isfinite(p.y_m) && std::isfinite(p.z_m);
}

using PointCloud = std::vector<LidarPoint>;

}  // namespace pitwall::perception
