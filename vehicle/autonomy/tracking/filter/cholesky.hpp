// Cholesky factor of a small matrix, and what it solves.
//   in     the size of the upper left part that counts, at most N; its entries by a function of row
//          and column, symmetric and positive definite
//   out    factor(): L, lower triangular, with L L' = S. solved(): L^-1 b
//   errors an entry that is not positive definite gives NaN
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace pitwall::tracking {

template <std::size_t N, class Entry>
std::array<std::array<double, N>, N> factor(std::size_t size, Entry entry) {
  std::array<std::array<double, N>, N> l{};
  for (std::size_t i = 0; i < size; ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      double sum = entry(i, j);
      for (std::size_t k = 0; k < j; ++k) sum -= l[i][k] * l[j][k];
      l[i][j] = i == j ? std::sqrt(sum) : sum / l[j][j];
    }
  return l;
}

template <std::size_t N>
std::array<double, N> solved(const std::array<std::array<double, N>, N>& l, std::size_t size,
                             const std::array<double, N>& b) {
  std::array<double, N> y{};
  for (std::size_t i = 0; i < size; ++i) {
    double sum = b[i];
    for (std::size_t k = 0; k < i; ++k) sum -= l[i][k] * y[k];
    y[i] = sum / l[i][i];
  }
  return y;
}

}  // namespace pitwall::tracking
