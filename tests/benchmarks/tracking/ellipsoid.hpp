// Squared Mahalanobis distance of an error by its covariance, by Cholesky's factors.
//   out    e' P^-1 e; infinite where P is not positive definite
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace pitwall::tracking_bench {

template <std::size_t N>
double squared_distance(const std::array<double, N>& error,
                        const std::array<double, N * N>& covariance) {
  std::array<double, N * N> factor{};
  std::array<double, N> solved{};
  double sum = 0.0;
  for (std::size_t i = 0; i < N; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      double rest = covariance[i * N + j];
      for (std::size_t k = 0; k < j; ++k) rest -= factor[i * N + k] * factor[j * N + k];
      if (i == j && !(rest > 0.0)) return std::numeric_limits<double>::infinity();
      factor[i * N + j] = i == j ? std::sqrt(rest) : rest / factor[j * N + j];
    }
    solved[i] = error[i];
    for (std::size_t k = 0; k < i; ++k) solved[i] -= factor[i * N + k] * solved[k];
    solved[i] /= factor[i * N + i];
    sum += solved[i] * solved[i];
  }
  return sum;
}

}  // namespace pitwall::tracking_bench
