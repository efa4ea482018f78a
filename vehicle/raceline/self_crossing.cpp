// SPDX-License-Identifier: Apache-2.0
#include "vehicle/raceline/self_crossing.hpp"

#include <algorithm>
#include <vector>

namespace pitwall::raceline {
namespace {

constexpr std::size_t kPiecesInBox = 32;

struct Box {
  double low_x, high_x, low_y, high_y;
  std::size_t first, last;  // pieces

  bool meets(const Box& b) const {
    return low_x <= b.high_x && b.low_x <= high_x && low_y <= b.high_y && b.low_y <= high_y;
  }
};

// Positive where p lies to the left of the way from a to b.
double side_of(const RacelinePoint& a, const RacelinePoint& b, const RacelinePoint& p) {
  return (b.x_m - a.x_m) * (p.y_m - a.y_m) - (b.y_m - a.y_m) * (p.x_m - a.x_m);
}

std::vector<Box> boxes_of(std::span<const RacelinePoint> points) {
  std::vector<Box> boxes;
  for (std::size_t first = 0; first < points.size(); first += kPiecesInBox) {
    const std::size_t last = std::min(first + kPiecesInBox, points.size());
    const RacelinePoint& p = points[first];
    Box box{p.x_m, p.x_m, p.y_m, p.y_m, first, last};
    for (std::size_t i = first; i <= last; ++i) {
      const RacelinePoint& q = points[i % points.size()];
      box.low_x = std::min(box.low_x, q.x_m), box.high_x = std::max(box.high_x, q.x_m);
      box.low_y = std::min(box.low_y, q.y_m), box.high_y = std::max(box.high_y, q.y_m);
    }
    boxes.push_back(box);
  }
  return boxes;
}

}  // namespace

std::optional<std::pair<std::size_t, std::size_t>> self_crossing_of(
    std::span<const RacelinePoint> points) {
  const std::size_t n = points.size();
  const std::vector<Box> boxes = boxes_of(points);
  const auto pieces_cross = [&](std::size_t i, std::size_t j) {
    if (j <= i) return false;  // neighbours share an end, which lies on neither side
    const RacelinePoint &a = points[i], &b = points[i + 1], &c = points[j],
                        &d = points[(j + 1) % n];
    return side_of(a, b, c) * side_of(a, b, d) < 0.0 && side_of(c, d, a) * side_of(c, d, b) < 0.0;
  };
  for (std::size_t k = 0; k < boxes.size(); ++k)
    for (std::size_t l = k; l < boxes.size(); ++l) {
      if (!boxes[k].meets(boxes[l])) continue;
      for (std::size_t i = boxes[k].first; i < boxes[k].last; ++i)
        for (std::size_t j = boxes[l].first; j < boxes[l].last; ++j)
          if (pieces_cross(i, j)) return std::pair{i, j};
    }
  return std::nullopt;
}

}  // namespace pitwall::raceline
