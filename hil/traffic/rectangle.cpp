// SPDX-License-Identifier: Apache-2.0
#include "hil/traffic/rectangle.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "protocol/vocabulary/fixed_vector.hpp"

namespace pitwall::traffic {
namespace {

constexpr double kSame_m = 1e-9;  // distances that differ by less are equal
constexpr double kNoArea_m2 = 1e-12;

struct Box {
  std::array<Vector2, 2> axes;     // along and across
  std::array<Vector2, 4> corners;  // counter-clockwise
};

bool is_finite(const Rectangle& r) {
  return std::isfinite(r.centre_m.x + r.centre_m.y + r.yaw_rad + r.length_m + r.width_m);
}

Box box_of(const Rectangle& r) {
  const Vector2 along{std::cos(r.yaw_rad), std::sin(r.yaw_rad)}, across{-along.y, along.x};
  const Vector2 front = 0.5 * r.length_m * along, left = 0.5 * r.width_m * across;
  const Vector2 c = r.centre_m;
  return {{along, across},
          {c + front - left, c + front + left, c - front + left, c - front - left}};
}

double reach_m(const Box& box, Vector2 centre_m, Vector2 axis) {
  double reach = 0.0;
  for (const Vector2 corner : box.corners) reach = std::max(reach, dot(corner - centre_m, axis));
  return reach;
}

// Positive: the rectangles are this far apart along the axis.
struct Separation {
  double distance_m = -std::numeric_limits<double>::infinity();
  Vector2 normal{};
};

Separation widest(const Rectangle& a, const Rectangle& b, const Box& box_a, const Box& box_b) {
  const Vector2 to_b = b.centre_m - a.centre_m;
  Separation best;
  for (const Box* box : {&box_a, &box_b})
    for (const Vector2 axis : box->axes) {
      const double centres_m = dot(to_b, axis);
      const double distance_m =
          std::abs(centres_m) - reach_m(box_a, a.centre_m, axis) - reach_m(box_b, b.centre_m, axis);
      if (distance_m > best.distance_m) best = {distance_m, std::copysign(1.0, centres_m) * axis};
    }
  return best;
}

// An intersection of two quadrangles has at most eight corners.
using Polygon = FixedVector<Vector2, 8>;

void add(Polygon& polygon, Vector2 point_m) {
  if (!polygon.full()) static_cast<void>(polygon.push(point_m));
}

// The part of the polygon to the left of the line from `from` to `to`.
Polygon clipped(const Polygon& polygon, Vector2 from_m, Vector2 to_m) {
  Polygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector2 here = polygon[i], next = polygon[(i + 1) % polygon.size()];
    const double side = cross(to_m - from_m, here - from_m);
    const double next_side = cross(to_m - from_m, next - from_m);
    if (side >= 0.0) add(kept, here);
    if ((side > 0.0 && next_side < 0.0) || (side < 0.0 && next_side > 0.0))
      add(kept, here + side / (side - next_side) * (next - here));
  }
  return kept;
}

Vector2 centre_of_overlap(const Box& a, const Box& b) {
  Polygon overlap;
  for (const Vector2 corner : a.corners) add(overlap, corner);
  for (std::size_t i = 0; i < b.corners.size(); ++i)
    overlap = clipped(overlap, b.corners[i], b.corners[(i + 1) % b.corners.size()]);
  if (overlap.empty()) return 0.25 * (a.corners[0] + a.corners[2] + b.corners[0] + b.corners[2]);
  Vector2 mean, moment;
  double area_m2 = 0.0;
  const Vector2 origin = overlap[0];
  for (std::size_t i = 0; i < overlap.size(); ++i) {
    const Vector2 p = overlap[i] - origin, q = overlap[(i + 1) % overlap.size()] - origin;
    const double twice_m2 = cross(p, q);
    area_m2 += 0.5 * twice_m2;
    moment = moment + twice_m2 / 6.0 * (p + q);
    mean = mean + 1.0 / static_cast<double>(overlap.size()) * p;
  }
  return origin + (area_m2 > kNoArea_m2 ? 1.0 / area_m2 * moment : mean);
}

// Nearest points of separate rectangles; where a stretch is equally near, the centre of it.
struct Nearest {
  double distance_m = std::numeric_limits<double>::infinity();
  Vector2 on_first_m{}, on_second_m{};
  int count = 0;
};

void take(Nearest& nearest, Vector2 on_first_m, Vector2 on_second_m) {
  const Vector2 way = on_second_m - on_first_m;
  const double distance_m = std::hypot(way.x, way.y);
  if (distance_m > nearest.distance_m + kSame_m) return;
  if (distance_m < nearest.distance_m - kSame_m) nearest = {.distance_m = distance_m};
  const double weight = 1.0 / ++nearest.count;
  nearest.distance_m = std::min(nearest.distance_m, distance_m);
  nearest.on_first_m = nearest.on_first_m + weight * (on_first_m - nearest.on_first_m);
  nearest.on_second_m = nearest.on_second_m + weight * (on_second_m - nearest.on_second_m);
}

Vector2 nearest_on_edge(Vector2 from_m, Vector2 to_m, Vector2 point_m) {
  const Vector2 edge = to_m - from_m;
  return from_m + std::clamp(dot(point_m - from_m, edge) / dot(edge, edge), 0.0, 1.0) * edge;
}

Nearest nearest_points(const Box& a, const Box& b) {
  Nearest nearest;
  for (std::size_t i = 0; i < a.corners.size(); ++i)
    for (std::size_t k = 0; k < b.corners.size(); ++k) {
      const Vector2 a_next = a.corners[(i + 1) % 4], b_next = b.corners[(k + 1) % 4];
      take(nearest, a.corners[i], nearest_on_edge(b.corners[k], b_next, a.corners[i]));
      take(nearest, nearest_on_edge(a.corners[i], a_next, b.corners[k]), b.corners[k]);
    }
  return nearest;
}

}  // namespace

Gap gap_between(const Rectangle& first, const Rectangle& second) {
  if (!is_finite(first) || !is_finite(second)) return {};
  const Box a = box_of(first), b = box_of(second);
  const Separation apart = widest(first, second, a, b);
  if (apart.distance_m <= 0.0) return {apart.distance_m, apart.normal, centre_of_overlap(a, b)};
  const Nearest nearest = nearest_points(a, b);
  const Vector2 way = nearest.on_second_m - nearest.on_first_m;
  const double length_m = std::hypot(way.x, way.y);
  return {.distance_m = nearest.distance_m,
          .normal = length_m > 0.0 ? 1.0 / length_m * way : apart.normal,
          .point_m = 0.5 * (nearest.on_first_m + nearest.on_second_m)};
}

}  // namespace pitwall::traffic
