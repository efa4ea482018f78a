// SPDX-License-Identifier: Apache-2.0
#include "vehicle/raceline/spline/banded_matrix.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "protocol/vocabulary/check.hpp"

namespace pitwall::raceline {

BandedMatrix::BandedMatrix(std::size_t order, std::size_t lower, std::size_t upper)
    : order_(order),
      lower_(lower),
      upper_(upper),
      width_(2 * lower + upper + 1),
      elements_(order * width_, 0.0) {}

void BandedMatrix::add(std::size_t row, std::size_t column, double value) {
  CHECK(row < order_ && column < order_ && column + lower_ >= row && column <= row + upper_);
  at(row, column) += value;
}

bool BandedMatrix::solve(std::vector<double>& b) {
  CHECK(b.size() == order_);
  double largest = 0.0;
  for (const double element : elements_) largest = std::max(largest, std::abs(element));
  const double least = largest * 1e-14;
  for (std::size_t k = 0; k < order_; ++k) {
    const std::size_t last_row = std::min(order_ - 1, k + lower_);
    const std::size_t last_column = std::min(order_ - 1, k + lower_ + upper_);
    std::size_t pivot = k;
    for (std::size_t row = k + 1; row <= last_row; ++row)
      if (std::abs(at(row, k)) > std::abs(at(pivot, k))) pivot = row;
    if (!(std::abs(at(pivot, k)) > least)) return false;
    if (pivot != k) {
      for (std::size_t column = k; column <= last_column; ++column)
        std::swap(at(k, column), at(pivot, column));
      std::swap(b[k], b[pivot]);
    }
    for (std::size_t row = k + 1; row <= last_row; ++row) {
      const double factor = at(row, k) / at(k, k);
      if (factor == 0.0) continue;
      for (std::size_t column = k + 1; column <= last_column; ++column)
        at(row, column) -= factor * at(k, column);
      b[row] -= factor * b[k];
    }
  }
  for (std::size_t k = order_; k-- > 0;) {
    const std::size_t last_column = std::min(order_ - 1, k + lower_ + upper_);
    for (std::size_t column = k + 1; column <= last_column; ++column)
      b[k] -= at(k, column) * b[column];
    b[k] /= at(k, k);
  }
  return true;
}

}  // namespace pitwall::raceline
