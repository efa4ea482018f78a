// Where a sensor is mounted on the car.
//   frames the sensor's: x ahead along its axis, y left, z up. Body: ISO 8855. The sensor is turned
//          by yaw, then pitch (its nose down), then roll
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

namespace pitwall::perception {

struct SensorPose {  // in Body
  double x_m = 0.0, y_m = 0.0, z_m = 0.0;
  double roll_rad = 0.0, pitch_rad = 0.0, yaw_rad = 0.0;
};

using SensorAxes = std::array<std::array<double, 3>, 3>;

// Column k: the sensor's axis k in Body.
SensorAxes axes_of(const SensorPose& pose);

// A place in the sensor's frame, in Body.
std::array<double, 3> in_body(const SensorPose& pose, const SensorAxes& axes,
                              const std::array<double, 3>& at);

}  // namespace pitwall::perception
