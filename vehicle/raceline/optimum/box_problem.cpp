// SPDX-License-Identifier: Apache-2.0
#include "vehicle/raceline/optimum/box_problem.hpp"

#include <algorithm>
#include <cmath>

#include "protocol/vocabulary/check.hpp"
#include "vehicle/raceline/spline/banded_matrix.hpp"

namespace pitwall::raceline {
namespace {

constexpr int kIterationsMax = 100;
constexpr double kCentring = 0.1;       // of the gap, that a step aims at
constexpr double kToBoundary = 0.995;   // of the way to the nearest bound
constexpr double kGapSettled = 1e-12;   // of the gap at the start
constexpr double kSlopeSettled = 1e-7;  // of the slope at the start; rounding leaves 1e-9 of it
constexpr std::size_t kVariablesMin = 2 * kReach + 1;

class InteriorPoint {
 public:
  explicit InteriorPoint(const BoxProblem& problem)
      : p_(problem), n_(problem.gradient.size()), x_(n_), below_(n_), above_(n_) {
    CHECK(n_ >= kVariablesMin && p_.hessian.size() == n_ && p_.low.size() == n_ &&
          p_.high.size() == n_);
    for (std::size_t i = 0; i < n_; ++i) {
      CHECK(p_.low[i] < p_.high[i]);
      x_[i] = 0.5 * (p_.low[i] + p_.high[i]);
    }
    const double steep = std::max(largest(slopes()), 1e-12);
    for (std::size_t i = 0; i < n_; ++i) below_[i] = above_[i] = steep;
    slope_scale_ = steep;
  }

  std::optional<std::vector<double>> run() {
    const double first_gap = gap();
    for (int iteration = 0; iteration < kIterationsMax; ++iteration) {
      if (gap() <= kGapSettled * first_gap && largest(imbalance()) <= kSlopeSettled * slope_scale_)
        return x_;
      if (!step(kCentring * gap())) return std::nullopt;
    }
    return std::nullopt;
  }

 private:
  static double largest(const std::vector<double>& values) {
    double most = 0.0;
    for (const double value : values) most = std::max(most, std::abs(value));
    return most;
  }

  // H x + g.
  std::vector<double> slopes() const {
    std::vector<double> slope = p_.gradient;
    for (std::size_t i = 0; i < n_; ++i) {
      slope[i] += p_.hessian[i][0] * x_[i];
      for (std::size_t k = 1; k <= kReach; ++k) {
        const std::size_t j = (i + k) % n_;
        slope[i] += p_.hessian[i][k] * x_[j];
        slope[j] += p_.hessian[i][k] * x_[i];
      }
    }
    return slope;
  }

  // The slope that the multipliers of the bounds do not hold.
  std::vector<double> imbalance() const {
    std::vector<double> rest = slopes();
    for (std::size_t i = 0; i < n_; ++i) rest[i] += above_[i] - below_[i];
    return rest;
  }

  // Mean product of the distance to a bound and its multiplier.
  double gap() const {
    double sum = 0.0;
    for (std::size_t i = 0; i < n_; ++i)
      sum += below_[i] * (x_[i] - p_.low[i]) + above_[i] * (p_.high[i] - x_[i]);
    return sum / static_cast<double>(2 * n_);
  }

  // The change of x by Newton's method towards products of `target`. Each variable is measured by
  // the root of its diagonal element: at a bound that is larger by many orders than elsewhere.
  std::optional<std::vector<double>> newton(double target) const {
    constexpr std::size_t kBand = 2 * kReach;  // of the folded row
    std::vector<double> unit(n_), right = slopes();
    for (std::size_t i = 0; i < n_; ++i) {
      const double under = x_[i] - p_.low[i], over = p_.high[i] - x_[i];
      unit[i] = 1.0 / std::sqrt(p_.hessian[i][0] + below_[i] / under + above_[i] / over);
      right[i] = -right[i] + target / under - target / over;
    }
    BandedMatrix matrix{n_, kBand, kBand};
    std::vector<double> scaled(n_), dx(n_);
    for (std::size_t i = 0; i < n_; ++i) {
      const std::size_t row = folded(i, n_);
      scaled[row] = unit[i] * right[i];
      matrix.add(row, row, 1.0);
      for (std::size_t k = 1; k <= kReach; ++k) {
        const std::size_t j = (i + k) % n_, column = folded(j, n_);
        matrix.add(row, column, unit[i] * unit[j] * p_.hessian[i][k]);
        matrix.add(column, row, unit[i] * unit[j] * p_.hessian[i][k]);
      }
    }
    if (!matrix.solve(scaled)) return std::nullopt;
    for (std::size_t i = 0; i < n_; ++i) dx[i] = unit[i] * scaled[folded(i, n_)];
    return dx;
  }

  // Along that change as far as everything stays positive.
  bool step(double target) {
    const auto dx = newton(target);
    if (!dx) return false;
    std::vector<double> d_below(n_), d_above(n_);
    double share = 1.0;
    const auto keep_positive = [&](double value, double change) {
      if (value + share * change < (1.0 - kToBoundary) * value)
        share = -kToBoundary * value / change;
    };
    for (std::size_t i = 0; i < n_; ++i) {
      const double under = x_[i] - p_.low[i], over = p_.high[i] - x_[i], d = (*dx)[i];
      d_below[i] = (target - below_[i] * d) / under - below_[i];
      d_above[i] = (target + above_[i] * d) / over - above_[i];
      keep_positive(under, d), keep_positive(over, -d);
      keep_positive(below_[i], d_below[i]), keep_positive(above_[i], d_above[i]);
    }
    for (std::size_t i = 0; i < n_; ++i) {
      x_[i] += share * (*dx)[i];
      below_[i] += share * d_below[i], above_[i] += share * d_above[i];
    }
    return true;
  }

  const BoxProblem& p_;
  std::size_t n_;
  std::vector<double> x_, below_, above_;  // multipliers of the bounds
  double slope_scale_ = 0.0;
};

}  // namespace

std::optional<std::vector<double>> minimise(const BoxProblem& problem) {
  return InteriorPoint{problem}.run();
}

}  // namespace pitwall::raceline
