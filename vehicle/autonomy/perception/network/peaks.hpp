// Things in the output of a network that says of each cell whether the middle of one is there.
//   in     planes, the first of them logits
//   out    cells whose logit is at least that of the confidence, and the greatest of the cell and
//          the eight around it; of equal ones the first. What these cells say of it, as a mean
//   source X. Zhou, D. Wang, P. Kraehenbuehl: Objects as points, 2019, section 4
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace pitwall::perception {

struct OutputPlanes {
  std::span<const float> planes;
  std::size_t rows, columns;

  float at(std::size_t plane, std::size_t row, std::size_t column) const {
    return planes[(plane * rows + row) * columns + column];
  }
};

struct Cell {
  std::size_t row, column;
};

inline double share_of_logit(double logit) { return 1.0 / (1.0 + std::exp(-logit)); }

std::vector<Cell> peaks_of(const OutputPlanes& out, double confidence_least);

// What the cells of one thing say of it: its peak and the eight around it, each as much as it is
// sure. Their errors are not the same.
class AroundPeak {
 public:
  AroundPeak(const OutputPlanes& out, const Cell& peak);

  double mean(std::size_t plane) const;
  // Of places that a plane has from the middle of each cell, in cells from the first one.
  double mean_row(std::size_t plane) const;
  double mean_column(std::size_t plane) const;

 private:
  struct Part {
    Cell cell;
    double share;
  };
  const OutputPlanes& out_;
  std::vector<Part> parts_;
};

// Non-maximum suppression: of those that are one thing the first.
template <class Box, class Same>
std::vector<Box> surest(const std::vector<Box>& boxes, const Same& is_same) {
  std::vector<Box> kept;
  for (const Box& box : boxes)
    if (std::ranges::none_of(kept, [&](const Box& other) { return is_same(other, box); }))
      kept.push_back(box);
  return kept;
}

}  // namespace pitwall::perception
