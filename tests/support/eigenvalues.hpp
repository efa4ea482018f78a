// Eigenvalues for tests, by Eigen's solvers. They are behind this header: it costs a file that
// includes it nothing.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

namespace pitwall::testing {

// Of a square matrix, column by column: the largest real part, the largest modulus.
double largest_real_part(std::span<const double> matrix);
double largest_modulus(std::span<const double> matrix);
// Of a symmetric one: the smallest.
double smallest_eigenvalue(std::span<const double> matrix);

// The numbers of a matrix of Eigen's that is no expression.
template <class Matrix>
std::span<const double> numbers_of(const Matrix& matrix) {
  return {matrix.data(), static_cast<std::size_t>(matrix.size())};
}

}  // namespace pitwall::testing
