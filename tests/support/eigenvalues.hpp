// Eigenvalues for tests, by Eigen's solvers. The Eigen headers are not included here, so that
// including this file stays cheap.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

namespace pitwall::testing {

// Of a square matrix, column by column: largest real part and largest modulus of its eigenvalues.
double largest_real_part(std::span<const double> matrix);
double largest_modulus(std::span<const double> matrix);
// Smallest eigenvalue of a symmetric matrix.
double smallest_eigenvalue(std::span<const double> matrix);

// Coefficients of an Eigen matrix (not of an expression).
template <class Matrix>
std::span<const double> numbers_of(const Matrix& matrix) {
  return {matrix.data(), static_cast<std::size_t>(matrix.size())};
}

}  // namespace pitwall::testing
