// Distance of two oriented rectangles, which stand for cars seen from above.
//   in     two rectangles in one plane, with positive sides
//   out    gap: the distance of the rectangles; where they overlap, minus the shortest way that
//          parts them. A contact is a gap of zero or less
//          normal: unit vector from the first to the second, along the distance or along that way
//          point: the centre of the nearest points, or of the overlap
//   invariants
//          exchanging the two turns the normal round and changes nothing else; moving and turning
//          both together moves and turns normal and point
//   errors a value that is not a number: the gap is NaN
//   cost   O(1), no allocation
//   source separating axis theorem: Ericson, Real-Time Collision Detection (2005), section 5.2.1;
//          clipping: Sutherland and Hodgman, CACM 17 (1974)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hil/plant/car_pose.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::traffic {

struct Vector2 {
  double x = 0.0, y = 0.0;
};
constexpr Vector2 operator+(Vector2 a, Vector2 b) { return {a.x + b.x, a.y + b.y}; }
constexpr Vector2 operator-(Vector2 a, Vector2 b) { return {a.x - b.x, a.y - b.y}; }
constexpr Vector2 operator*(double k, Vector2 a) { return {k * a.x, k * a.y}; }
constexpr double dot(Vector2 a, Vector2 b) { return a.x * b.x + a.y * b.y; }
constexpr double cross(Vector2 a, Vector2 b) { return a.x * b.y - a.y * b.x; }

struct Rectangle {
  Vector2 centre_m{};
  double yaw_rad = kUnset;  // of the long side
  double length_m = kUnset, width_m = kUnset;
};

struct Gap {
  double distance_m = kUnset;
  Vector2 normal{};
  Vector2 point_m{};
};

Gap gap_between(const Rectangle& first, const Rectangle& second);

inline Rectangle rectangle_of(const plant::CarPose& car) {
  return {{car.x_m, car.y_m}, car.yaw_rad, car.length_m, car.width_m};
}

}  // namespace pitwall::traffic
