// Attitude of the car as a rotation: vectors of the car frame in the map frame, compass bearings.
//   frames Body: ISO 8855. Map: east, north, up. Euler angles in the order yaw, pitch, roll
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "hil/plant/plant.hpp"
#include "hil/sensors/unit_params.hpp"

namespace pitwall::sensors {

using Vector3 = std::array<double, 3>;

constexpr Vector3 vector(const Lever& l) { return {l.x_m, l.y_m, l.z_m}; }
constexpr Vector3 plus(const Vector3& a, const Vector3& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
constexpr Vector3 times(double factor, const Vector3& a) {
  return {factor * a[0], factor * a[1], factor * a[2]};
}
constexpr double dot(const Vector3& a, const Vector3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
constexpr Vector3 cross(const Vector3& a, const Vector3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

struct Attitude {
  double roll_rad = 0.0, pitch_rad = 0.0, yaw_rad = 0.0;
};

inline Vector3 in_map(const Vector3& v, const Attitude& a) {
  const double cos_roll = std::cos(a.roll_rad), sin_roll = std::sin(a.roll_rad);
  const double cos_pitch = std::cos(a.pitch_rad), sin_pitch = std::sin(a.pitch_rad);
  const double cos_yaw = std::cos(a.yaw_rad), sin_yaw = std::sin(a.yaw_rad);
  const double left = v[1] * cos_roll - v[2] * sin_roll;
  const double raised = v[1] * sin_roll + v[2] * cos_roll;
  const double ahead = v[0] * cos_pitch + raised * sin_pitch;
  return {ahead * cos_yaw - left * sin_yaw, ahead * sin_yaw + left * cos_yaw,
          raised * cos_pitch - v[0] * sin_pitch};
}

inline Vector3 in_map(const Vector3& v, const plant::Truth& t) {
  return in_map(v, Attitude{t.roll_rad, t.pitch_rad, t.yaw_rad});
}

// Of a rotation: the axes of the turned frame, in the frame around it.
using Rotation = std::array<Vector3, 3>;

inline Rotation rotation(const Attitude& a) {
  return {in_map({1.0, 0.0, 0.0}, a), in_map({0.0, 1.0, 0.0}, a), in_map({0.0, 0.0, 1.0}, a)};
}
constexpr Vector3 turned(const Rotation& r, const Vector3& v) {
  return plus(plus(times(v[0], r[0]), times(v[1], r[1])), times(v[2], r[2]));
}

// Bearing from north, clockwise, in [0, 2 pi).
inline double compass_rad(double east, double north) {
  const double angle_rad = std::atan2(east, north);
  return angle_rad < 0.0 ? angle_rad + 2.0 * std::numbers::pi : angle_rad;
}

}  // namespace pitwall::sensors
