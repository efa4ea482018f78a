// Least of a quadratic function of a closed row of variables, each between two bounds.
//   in     half of x^T H x + g^T x, with H symmetric and positive semi-definite, and elements other
//          than zero only for variables that are at most two apart in the row; low < high
//   out    x strictly between the bounds, and within rounding of the least
//   errors nothing where the iteration does not settle
//   cost   O(variables) an iteration, about 20 of them
//   source primal-dual interior-point method: Nocedal and Wright, Numerical Optimization, 2nd ed.,
//          chapter 16.6
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace pitwall::raceline {

inline constexpr std::size_t kReach = 2;  // of a variable along the row

struct BoxProblem {
  // Row i of H: for the variables i, i + 1 and i + 2, the lap being closed.
  std::vector<std::array<double, kReach + 1>> hessian;
  std::vector<double> gradient;
  std::vector<double> low, high;
};

std::optional<std::vector<double>> minimise(const BoxProblem& problem);

}  // namespace pitwall::raceline
