// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/control/riccati.hpp"

#include <lapacke.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace pitwall::control {
namespace {

using Eigen::MatrixXd;
using Extended = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;

// Products below are lazyProduct: sums of coefficients, as Eigen takes them for such small matrices
// anyway. Its kernels for large ones would take this file most of the time that it compiles.

constexpr double kSymmetryTolerance = 1e-12;  // relative; a product B inv(R) B' is off by rounding
constexpr double kResidualMax = 1e-9;         // relative; a usual solution is at 1e-15
constexpr int kRefinementsMax = 12;           // Newton converges quadratically: two or three do

lapack_logical is_stable(const double* real, const double*) { return *real < 0.0; }

bool symmetric(const MatrixXd& m) {
  return (m - m.transpose()).norm() <= kSymmetryTolerance * std::max(m.norm(), 1e-300);
}

std::optional<RiccatiFailure> refusal(const RiccatiProblem& p) {
  const Eigen::Index n = p.a.rows();
  for (const MatrixXd* m : {&p.a, &p.g, &p.q}) {
    if (n == 0 || m->rows() != n || m->cols() != n) return RiccatiFailure::kWrongShape;
    if (!m->allFinite()) return RiccatiFailure::kNotFinite;
  }
  if (!symmetric(p.g) || !symmetric(p.q)) return RiccatiFailure::kNotSymmetric;
  return std::nullopt;
}

Extended residual(const RiccatiProblem& p, const MatrixXd& x) {
  const Extended a = p.a.cast<long double>(), g = p.g.cast<long double>();
  const Extended q = p.q.cast<long double>(), xe = x.cast<long double>();
  const Extended xa = xe.lazyProduct(a), xg = xe.lazyProduct(g), xgx = xg.lazyProduct(xe);
  return q + xa + xa.transpose() - xgx;
}

// Real Schur form m = u t u', in place; false if the iteration fails.
bool schur(MatrixXd& m, MatrixXd& u, lapack_int* stable) {
  const auto n = static_cast<lapack_int>(m.rows());
  std::vector<double> real(static_cast<std::size_t>(n)), imaginary(static_cast<std::size_t>(n));
  u.resize(n, n);
  lapack_int selected = 0;
  const lapack_int info = LAPACKE_dgees(LAPACK_COL_MAJOR, 'V', stable != nullptr ? 'S' : 'N',
                                        stable != nullptr ? is_stable : nullptr, n, m.data(), n,
                                        &selected, real.data(), imaginary.data(), u.data(), n);
  if (stable != nullptr) *stable = selected;
  return info == 0 && (stable != nullptr || *std::max_element(real.begin(), real.end()) < 0.0);
}

MatrixXd closed_loop(const RiccatiProblem& p, const MatrixXd& x) {
  const MatrixXd gx = p.g.lazyProduct(x);
  return p.a - gx;
}

// One step of Newton: X + D with  Ac' D + D Ac = -residual,  Ac = A - G X stable.
std::optional<MatrixXd> newton(const RiccatiProblem& p, const MatrixXd& x) {
  MatrixXd t = closed_loop(p, x), u;
  if (!schur(t, u, nullptr)) return std::nullopt;
  const auto n = static_cast<lapack_int>(t.rows());
  const MatrixXd left = u.transpose().lazyProduct(residual(p, x).cast<double>());
  const MatrixXd right = left.lazyProduct(u);
  MatrixXd d = -right;
  double scale = 1.0;
  if (LAPACKE_dtrsyl(LAPACK_COL_MAJOR, 'T', 'N', 1, n, n, t.data(), n, t.data(), n, d.data(), n,
                     &scale) < 0) {
    return std::nullopt;
  }
  const MatrixXd ud = u.lazyProduct(d), udu = ud.lazyProduct(u.transpose());
  const MatrixXd step = udu / scale;
  const MatrixXd next = x + 0.5 * (step + step.transpose());
  if (!next.allFinite()) return std::nullopt;
  return next;
}

// X of M X = B, by elimination with the largest pivot of each column; not finite if M is singular.
MatrixXd eliminate(MatrixXd m, MatrixXd b) {
  const Eigen::Index n = m.rows(), columns = b.cols();
  for (Eigen::Index k = 0; k < n; ++k) {
    Eigen::Index pivot = k;
    for (Eigen::Index i = k + 1; i < n; ++i)
      if (std::abs(m(i, k)) > std::abs(m(pivot, k))) pivot = i;
    m.row(k).swap(m.row(pivot));
    b.row(k).swap(b.row(pivot));
    for (Eigen::Index i = k + 1; i < n; ++i) {
      const double share = m(i, k) / m(k, k);
      for (Eigen::Index j = k + 1; j < n; ++j) m(i, j) -= share * m(k, j);
      for (Eigen::Index j = 0; j < columns; ++j) b(i, j) -= share * b(k, j);
    }
  }
  for (Eigen::Index i = n; i-- > 0;) {
    const double inverse = 1.0 / m(i, i);
    for (Eigen::Index j = 0; j < columns; ++j) {
      for (Eigen::Index k = i + 1; k < n; ++k) b(i, j) -= m(i, k) * b(k, j);
      b(i, j) *= inverse;
    }
  }
  return b;
}

// G and Q are brought to the same size first: X = s Y with G s and Q / s.
std::optional<MatrixXd> from_hamiltonian(const RiccatiProblem& p) {
  const Eigen::Index n = p.a.rows();
  const double g = p.g.norm(), q = p.q.norm();
  const double s = g > 0.0 && q > 0.0 ? std::sqrt(q / g) : 1.0;
  MatrixXd h(2 * n, 2 * n), u;
  h << p.a, -s * p.g, -p.q / s, -p.a.transpose();
  lapack_int stable = 0;
  if (!schur(h, u, &stable) || stable != n) return std::nullopt;
  const MatrixXd y =
      eliminate(u.topLeftCorner(n, n).transpose(), u.bottomLeftCorner(n, n).transpose())
          .transpose();
  if (!y.allFinite()) return std::nullopt;
  return 0.5 * s * (y + y.transpose());
}

bool stabilises(const RiccatiProblem& p, const MatrixXd& x) {
  MatrixXd t = closed_loop(p, x), u;
  return schur(t, u, nullptr);
}

}  // namespace

double relative_residual(const RiccatiProblem& p, const MatrixXd& x) {
  const MatrixXd xa = x.lazyProduct(p.a), xg = x.lazyProduct(p.g), xgx = xg.lazyProduct(x);
  const double size = p.q.norm() + 2.0 * xa.norm() + xgx.norm();
  return static_cast<double>(residual(p, x).norm()) / std::max(size, 1e-300);
}

Result<MatrixXd, RiccatiFailure> solve(const RiccatiProblem& problem) {
  if (const auto reason = refusal(problem)) return Unexpected{*reason};
  std::optional<MatrixXd> x = from_hamiltonian(problem);
  if (!x || !stabilises(problem, *x)) return Unexpected{RiccatiFailure::kNoStabilisingSolution};
  double best = relative_residual(problem, *x);
  for (int i = 0; i < kRefinementsMax; ++i) {
    const std::optional<MatrixXd> next = newton(problem, *x);
    if (!next || !stabilises(problem, *next)) break;
    const double now = relative_residual(problem, *next);
    if (!(now < best)) break;
    x = next;
    best = now;
  }
  if (!(best <= kResidualMax)) return Unexpected{RiccatiFailure::kNotAccurate};
  return *std::move(x);
}

const char* to_string(RiccatiFailure failure) {
  switch (failure) {
    case RiccatiFailure::kWrongShape:
      return "matrices are empty or of different sizes";
    case RiccatiFailure::kNotFinite:
      return "a matrix is not finite";
    case RiccatiFailure::kNotSymmetric:
      return "G or Q is not symmetric";
    case RiccatiFailure::kNoStabilisingSolution:
      return "no stabilising solution";
    case RiccatiFailure::kNotAccurate:
      return "residual too large";
  }
  return "unknown";
}

}  // namespace pitwall::control
