// Solver of the continuous-time algebraic Riccati equation
//     0 = Q + A'X + XA - X G X,  G = B inv(R) B'
//   in     A any, G and Q symmetric, all n by n
//   out    the stabilising solution X: symmetric, every eigenvalue of A - G X in the open left half
//          plane
//   errors RiccatiFailure
//   cost   O(n^3), allocates: start-up only
//   source Laub 1979 (ordered Schur form of the Hamiltonian), Kleinman 1968 (Newton refinement),
//          residual in extended precision
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "protocol/vocabulary/result.hpp"

namespace pitwall::control {

enum class RiccatiFailure : std::uint8_t {
  kWrongShape,             // sizes differ or are zero
  kNotFinite,              // NaN or infinity in the input
  kNotSymmetric,           // G or Q
  kNoStabilisingSolution,  // eigenvalues on the imaginary axis, or no graph subspace
  kNotAccurate             // residual too large after refinement
};

struct RiccatiProblem {
  Eigen::MatrixXd a, g, q;
};

Result<Eigen::MatrixXd, RiccatiFailure> solve(const RiccatiProblem& problem);

// Residual Q + A'X + XA - XGX, computed in extended precision and rounded, divided by the sum of
// the magnitudes of its terms.
double relative_residual(const RiccatiProblem& problem, const Eigen::MatrixXd& x);

const char* to_string(RiccatiFailure failure);

}  // namespace pitwall::control
