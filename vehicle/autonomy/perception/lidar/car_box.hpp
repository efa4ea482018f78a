// A car that a LiDAR found.
//   frames Body of our car at the reference time, or that of the sensor
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstddef>

#include "protocol/vocabulary/units.hpp"

namespace pitwall::perception {

struct CarBox {
  double x_m = kUnset, y_m = kUnset;  // centre
  double yaw_rad = kUnset;            // front and back may be exchanged
  double length_m = kUnset, width_m = kUnset;
  double ground_m = kUnset, height_m = kUnset;  // of the ground; of the car over it
  double confidence = kUnset;                   // that it is a car
  std::size_t points = 0;
};

// Two cars are never in one place: what seems so is one.
inline bool is_same_place(const CarBox& car, const CarBox& other) {
  constexpr double kShare = 0.9;
  const double c = std::cos(car.yaw_rad), s = std::sin(car.yaw_rad);
  const double dx_m = other.x_m - car.x_m, dy_m = other.y_m - car.y_m;
  return std::abs(dx_m * c + dy_m * s) < kShare * car.length_m &&
         std::abs(dy_m * c - dx_m * s) < kShare * car.width_m;
}

}  // namespace pitwall::perception
