// SPDX-License-Identifier: Apache-2.0
#include "vehicle/raceline/optimum/box_problem.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "protocol/vocabulary/random.hpp"

namespace pitwall::raceline {
namespace {

// H of second differences and a random diagonal, which is positive definite.
BoxProblem drawn(std::size_t n, std::uint64_t seed) {
  Random random{seed};
  BoxProblem p{std::vector<std::array<double, kReach + 1>>(n), {}, {}, {}};
  const std::array<double, 3> difference{1.0, -2.0, 1.0};
  for (std::size_t i = 0; i < n; ++i) {
    const double weight = random.between(0.5, 2.0);
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t l = k; l < 3; ++l)
        p.hessian[(i + k) % n][l - k] += weight * difference[k] * difference[l];
    p.hessian[i][0] += random.between(0.01, 0.1);
    p.gradient.push_back(random.between(-1.0, 1.0));
    const double middle = random.between(-1.0, 1.0), half = random.between(0.05, 2.0);
    p.low.push_back(middle - half), p.high.push_back(middle + half);
  }
  return p;
}

std::vector<double> slopes_of(const BoxProblem& p, const std::vector<double>& x) {
  const std::size_t n = x.size();
  std::vector<double> slope = p.gradient;
  for (std::size_t i = 0; i < n; ++i) {
    slope[i] += p.hessian[i][0] * x[i];
    for (std::size_t k = 1; k <= kReach; ++k) {
      slope[i] += p.hessian[i][k] * x[(i + k) % n];
      slope[(i + k) % n] += p.hessian[i][k] * x[i];
    }
  }
  return slope;
}

// The conditions of an optimum: no slope between the bounds, and at a bound one that leads out.
TEST(BoxProblem, LeastHasNoSlopeThatLeadsInward) {
  std::size_t held = 0, loose = 0;
  for (const std::size_t n : {5U, 6U, 40U, 301U}) {
    const BoxProblem p = drawn(n, n);
    const auto x = minimise(p);
    ASSERT_TRUE(x) << n;
    const std::vector<double> slope = slopes_of(p, *x);
    for (std::size_t i = 0; i < n; ++i) {
      EXPECT_GT((*x)[i], p.low[i]);
      EXPECT_LT((*x)[i], p.high[i]);
      const bool is_low = (*x)[i] - p.low[i] < 1e-7, is_high = p.high[i] - (*x)[i] < 1e-7;
      if (!is_low) {
        EXPECT_LT(slope[i], 1e-6) << n << " " << i;
      }
      if (!is_high) {
        EXPECT_GT(slope[i], -1e-6) << n << " " << i;
      }
      is_low || is_high ? ++held : ++loose;
    }
  }
  EXPECT_GT(held, 50U);
  EXPECT_GT(loose, 50U);
}

// With bounds far away it is the solution of the linear system; here one that is known.
TEST(BoxProblem, WithoutBoundsThatHoldIsTheStationaryPoint) {
  BoxProblem p = drawn(60, 3);
  std::vector<double> known;
  for (int i = 0; i < 60; ++i) known.push_back(std::sin(0.7 * i));
  std::ranges::fill(p.gradient, 0.0);
  std::vector<double> product = slopes_of(p, known);
  for (std::size_t i = 0; i < known.size(); ++i) {
    p.gradient[i] = -product[i];
    p.low[i] = -100.0, p.high[i] = 100.0;
  }
  const auto x = minimise(p);
  ASSERT_TRUE(x);
  for (std::size_t i = 0; i < known.size(); ++i) EXPECT_NEAR((*x)[i], known[i], 1e-6) << i;
}

}  // namespace
}  // namespace pitwall::raceline
