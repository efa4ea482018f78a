// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/control/riccati.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>

#include "protocol/vocabulary/random.hpp"
#include "tests/support/eigenvalues.hpp"

namespace pitwall::control {
namespace {

using Eigen::MatrixXd;

MatrixXd random_matrix(Random& random, Eigen::Index rows, Eigen::Index columns) {
  MatrixXd m(rows, columns);
  for (Eigen::Index i = 0; i < m.size(); ++i) m(i) = random.between(-1.0, 1.0);
  return m;
}

double largest_real_part(const MatrixXd& m) {
  return pitwall::testing::largest_real_part(pitwall::testing::numbers_of(m));
}

// The laws of a stabilising solution.
void expect_stabilising(const RiccatiProblem& p, const MatrixXd& x, const std::string& what) {
  EXPECT_LT(relative_residual(p, x), 1e-12) << what;
  EXPECT_LE((x - x.transpose()).norm(), 1e-14 * x.norm()) << what;
  EXPECT_LT(largest_real_part(p.a - p.g * x), 0.0) << what;
}

TEST(Riccati, ScalarHasItsClosedForm) {
  // 0 = q + 2 a x - g x^2
  for (const double a : {-3.0, -0.1, 0.0, 2.0}) {
    for (const double q : {0.5, 1.0, 1e6}) {
      const RiccatiProblem p{MatrixXd::Constant(1, 1, a), MatrixXd::Constant(1, 1, 2.0),
                             MatrixXd::Constant(1, 1, q)};
      const auto x = solve(p);
      ASSERT_TRUE(x) << a << ' ' << q;
      const double exact = (a + std::sqrt(a * a + 2.0 * q)) / 2.0;
      EXPECT_NEAR((*x)(0, 0), exact, 1e-14 * exact);
    }
  }
}

TEST(Riccati, RandomSystemsObeyTheLaws) {
  Random random{1};
  for (Eigen::Index n = 1; n <= 8; ++n) {
    for (int i = 0; i < 20; ++i) {
      const MatrixXd b = random_matrix(random, n, 2), c = random_matrix(random, n, n);
      const RiccatiProblem p{3.0 * random_matrix(random, n, n), b * b.transpose(),
                             c.transpose() * c};
      const auto x = solve(p);
      ASSERT_TRUE(x) << n << ' ' << i;
      expect_stabilising(p, *x, std::to_string(n));
      EXPECT_GE(pitwall::testing::smallest_eigenvalue(pitwall::testing::numbers_of(*x)),
                -1e-9 * x->norm());
    }
  }
}

TEST(Riccati, ScalesAcrossManyOrdersOfMagnitude) {
  // X of (A, G, Q) is X / s of (A, G s, Q / s).
  Random random{7};
  const MatrixXd b = random_matrix(random, 4, 1);
  const RiccatiProblem p{random_matrix(random, 4, 4), b * b.transpose(), MatrixXd::Identity(4, 4)};
  const auto x = solve(p);
  ASSERT_TRUE(x);
  for (const double s : {1e-8, 1e-3, 1e4, 1e9}) {
    const auto scaled = solve({p.a, p.g * s, p.q / s});
    ASSERT_TRUE(scaled) << s;
    EXPECT_LT((*scaled * s - *x).norm(), 1e-9 * x->norm()) << s;
  }
}

TEST(Riccati, RefusesWithTheReason) {
  const MatrixXd one = MatrixXd::Identity(2, 2), zero = MatrixXd::Zero(2, 2);
  const auto reason = [](const RiccatiProblem& p) { return solve(p).error(); };
  EXPECT_EQ(reason({MatrixXd::Zero(2, 3), one, one}), RiccatiFailure::kWrongShape);
  EXPECT_EQ(reason({one, MatrixXd::Identity(3, 3), one}), RiccatiFailure::kWrongShape);
  EXPECT_EQ(reason({MatrixXd(), MatrixXd(), MatrixXd()}), RiccatiFailure::kWrongShape);
  EXPECT_EQ(reason({one / 0.0, one, one}), RiccatiFailure::kNotFinite);
  MatrixXd lopsided = one;
  lopsided(0, 1) = 0.5;
  EXPECT_EQ(reason({one, lopsided, one}), RiccatiFailure::kNotSymmetric);
  EXPECT_EQ(reason({one, one, lopsided}), RiccatiFailure::kNotSymmetric);
  // Unstable without an input; an integrator that nobody pays for (undetectable).
  EXPECT_EQ(reason({one, zero, one}), RiccatiFailure::kNoStabilisingSolution);
  EXPECT_EQ(reason({zero, one, zero}), RiccatiFailure::kNoStabilisingSolution);
}

// Of two states, by rows; out of the collection of Abels and Benner, SLICOT working note 1999-14.
TEST(Riccati, FindsTheSolutionsThatAreKnown) {
  struct Example {
    const char* name;
    std::array<double, 4> a, g, q, x;
  };
  const Example examples[]{
      {"Laub 1979, example 1", {0, 1, 0, 0}, {0, 0, 0, 1}, {1, 0, 0, 2}, {2, 1, 1, 2}},
      {"Laub 1979, example 2: neither controllable nor observable",
       {4, 3, -4.5, -3.5},
       {1, -1, -1, 1},
       {9, 6, 6, 4},
       {21.727922061357855, 14.48528137423857, 14.48528137423857, 9.6568542494923797}},
      {"Arnold and Laub 1984, example 1: hardly stabilisable",
       {1, 0, 0, -2},
       {9.9999999999999998e-13, 0, 0, 0},
       {1, 1, 1, 1},
       {2000000000000.5002, 0.33333333333327775, 0.33333333333327775, 0.24999999999997222}},
      {"Kenney, Laub and Wette 1989, example 2: ill conditioned",
       {0, 1000000, 0, 0},
       {0, 0, 0, 1},
       {1, 0, 0, 1},
       {0.0014142139159264413, 1, 1, 1414.2139159264414}},
      {"Laub 1992: an H-infinity problem with eigenvalues near the imaginary axis",
       {3, 1, 4, 2},
       {1, 1, 1, 1},
       {-11, -5, -5, -2},
       {2, 1, 1, 1}},
  };
  const auto matrix = [](const std::array<double, 4>& rows) -> MatrixXd {
    return Eigen::Map<const Eigen::Matrix<double, 2, 2, Eigen::RowMajor>>(rows.data());
  };
  for (const Example& e : examples) {
    const RiccatiProblem p{matrix(e.a), matrix(e.g), matrix(e.q)};
    const auto x = solve(p);
    ASSERT_TRUE(x) << e.name << ": " << to_string(x.error());
    EXPECT_LT((*x - matrix(e.x)).norm(), 1e-6 * matrix(e.x).norm()) << e.name;
    EXPECT_LT(relative_residual(p, *x), 1e-13) << e.name;
    EXPECT_LT(largest_real_part(p.a - p.g * *x), 1e-7) << e.name;
  }
}

// Laub 1979, example 5, of the same collection (3.2): circulant, so that the solution is known by
// its eigenvalues, at any size.
TEST(Riccati, FindsTheCirculantSolution) {
  constexpr Eigen::Index n = 64;
  const double step_rad = 2.0 * std::acos(-1.0) / static_cast<double>(n);
  MatrixXd a = MatrixXd::Zero(n, n), exact = MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    a(i, i) = -2.0;
    a(i, (i + 1) % n) = a(i, (i + n - 1) % n) = 1.0;
  }
  for (Eigen::Index k = 0; k < n; ++k) {
    const double of_a = -2.0 + 2.0 * std::cos(step_rad * static_cast<double>(k));
    const double of_x = of_a + std::sqrt(of_a * of_a + 1.0);
    for (Eigen::Index i = 0; i < n; ++i)
      for (Eigen::Index j = 0; j < n; ++j)
        exact(i, j) +=
            of_x * std::cos(step_rad * static_cast<double>(k * (i - j))) / static_cast<double>(n);
  }
  const RiccatiProblem p{a, MatrixXd::Identity(n, n), MatrixXd::Identity(n, n)};
  const auto x = solve(p);
  ASSERT_TRUE(x) << to_string(x.error());
  EXPECT_LT((*x - exact).norm(), 1e-6 * exact.norm());
  EXPECT_LT(relative_residual(p, *x), 1e-13);
  EXPECT_LT(largest_real_part(p.a - p.g * *x), 0.0);
}

// Examples 1.4 and 2.7 of the collection, whose solutions nobody has in closed form.
TEST(Riccati, SolvesTheDistillationColumn) {  // Bhattacharyya and others 1983
  const double below[]{0.522, 0.522, 0.522, 0.922, 0.922, 0.922, 0.922};
  const double diagonal[]{-0.991, -1.051, -1.118, -1.548, -1.64, -1.721, -1.823, -1.943};
  const double above[]{0.529, 0.596, 0.596, 0.718, 0.799, 0.901, 1.021};
  MatrixXd a = MatrixXd::Zero(8, 8), b(8, 2), q = MatrixXd::Zero(8, 8);
  a.diagonal() = Eigen::Map<const Eigen::VectorXd>(diagonal, 8);
  a.diagonal(-1) = Eigen::Map<const Eigen::VectorXd>(below, 7);
  a.diagonal(1) = Eigen::Map<const Eigen::VectorXd>(above, 7);
  b << 3.84, -2.88, 4.0, -3.04, 37.6, -2.8, 3.08, -2.32, 2.36, -3.32, 2.88, -3.82, 3.08, -4.12, 3.0,
      -3.96;
  b *= 1e-3;
  q.diagonal() << 1.0, 1.0, 1.0, 1.0, 0.1, 0.1, 0.1, 0.1;
  q(0, 4) = q(4, 0) = q(2, 5) = q(5, 2) = 0.5;
  q(0, 7) = q(7, 0) = q(1, 4) = q(4, 1) = 0.1;
  const RiccatiProblem p{a, b * b.transpose(), q};
  const auto x = solve(p);
  ASSERT_TRUE(x) << to_string(x.error());
  EXPECT_LT(relative_residual(p, *x), 1e-13);
  EXPECT_LT(largest_real_part(p.a - p.g * *x), 1e-7);
}

TEST(Riccati, SolvesTheMagneticTapeControl) {  // Chow and Kokotovic 1976
  RiccatiProblem p{MatrixXd::Zero(4, 4), MatrixXd::Zero(4, 4), MatrixXd::Zero(4, 4)};
  p.a(0, 1) = 0.4;
  p.a(1, 2) = 0.345;
  p.a.row(2) << 0.0, -524'000.0, -465'000.0, 262'000.0;
  p.a(3, 3) = -1e6;
  p.g(3, 3) = 1e12;
  p.q(0, 0) = p.q(2, 2) = 1.0;
  const auto x = solve(p);
  ASSERT_TRUE(x) << to_string(x.error());
  EXPECT_LT(relative_residual(p, *x), 1e-13);
  EXPECT_LT(largest_real_part(p.a - p.g * *x), 1e-7);
}

}  // namespace
}  // namespace pitwall::control
