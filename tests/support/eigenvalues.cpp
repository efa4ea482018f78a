// SPDX-License-Identifier: Apache-2.0
#include "tests/support/eigenvalues.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace pitwall::testing {
namespace {

using Square = Eigen::Map<const Eigen::MatrixXd>;

Square square(std::span<const double> matrix) {
  const auto rows = std::lround(std::sqrt(static_cast<double>(matrix.size())));
  return {matrix.data(), rows, rows};
}

Eigen::VectorXcd eigenvalues(std::span<const double> matrix) {
  return Eigen::EigenSolver<Eigen::MatrixXd>(square(matrix), false).eigenvalues();
}

}  // namespace

double largest_real_part(std::span<const double> matrix) {
  return eigenvalues(matrix).real().maxCoeff();
}

double largest_modulus(std::span<const double> matrix) {
  return eigenvalues(matrix).cwiseAbs().maxCoeff();
}

double smallest_eigenvalue(std::span<const double> matrix) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(square(matrix), Eigen::EigenvaluesOnly)
      .eigenvalues()
      .minCoeff();
}

}  // namespace pitwall::testing
