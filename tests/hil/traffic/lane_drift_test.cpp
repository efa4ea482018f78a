// SPDX-License-Identifier: Apache-2.0
#include "hil/traffic/lane_drift.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <vector>

namespace pitwall::traffic {
namespace {

static_assert(std::is_trivially_copyable_v<DriftState>);

DriftState seeded(std::uint64_t seed) {
  DriftState state;
  state.noise = sensors::Noise(seed, 1);
  return state;
}

// 20 000 correlation times: the variance of an estimate of variance or correlation is some 2 in
// 20 000, a standard deviation of 1 %; five of them.
TEST(LaneDrift, HasTheDeviationAndCorrelationOfItsProcess) {
  const DriftParams params{.sigma_m = 0.3, .correlation_s = 8.0, .most_m = 3.0};
  DriftState state = seeded(5);
  constexpr std::size_t kLag = 4;  // knots: one correlation time
  std::vector<double> n_m;
  for (int i = 0; i < 80'000; ++i) {
    advance(params, state, 2.0);
    n_m.push_back(drift_at(params, state).n_m);
  }
  double variance = 0.0, product = 0.0;
  for (std::size_t i = 0; i + kLag < n_m.size(); ++i) {
    variance += n_m[i] * n_m[i];
    product += n_m[i] * n_m[i + kLag];
  }
  variance /= static_cast<double>(n_m.size() - kLag);
  product /= static_cast<double>(n_m.size() - kLag);
  EXPECT_NEAR(variance, 0.09, 0.05 * 0.09);
  // Weights 1, 4, 1 of a process with correlation r = exp(-1/4) from knot to knot.
  const double r = std::exp(-0.25);
  const double expected =
      std::exp(-1.0) * (1.0 / r + 4.0 + r) * (1.0 / r + 4.0 + r) / (18.0 + 16.0 * r + 2.0 * r * r);
  EXPECT_NEAR(product / variance, expected, 0.05);
}

TEST(LaneDrift, StaysWithinItsLimitsAndIsSmooth) {
  const DriftParams params{.sigma_m = 1.0, .correlation_s = 4.0, .most_m = 0.5};
  DriftState state = seeded(6);
  constexpr double kStep_s = 0.01;
  double most_m = 0.0, most_mps2 = 0.0;
  Drift before = drift_at(params, state);
  for (int i = 0; i < 500'000; ++i) {
    advance(params, state, kStep_s);
    const Drift now = drift_at(params, state);
    // The mean of the rates over a step: off by a twelfth of the largest jerk times dt^2.
    EXPECT_NEAR((now.n_m - before.n_m) / kStep_s, 0.5 * (now.rate_mps + before.rate_mps), 1e-4);
    most_m = std::max(most_m, std::abs(now.n_m));
    most_mps2 = std::max(most_mps2, std::abs(now.rate_mps - before.rate_mps) / kStep_s);
    before = now;
  }
  EXPECT_LE(most_m, params.most_m + 1e-15);  // rounding of the sum
  EXPECT_GE(most_m, 0.9 * params.most_m);
  EXPECT_LE(most_mps2, most_accel_mps2(params) + 1e-9);
  EXPECT_DOUBLE_EQ(most_accel_mps2(params), 64.0 * 0.5 / 16.0);
}

TEST(LaneDrift, IsTheSameForASeedAndNothingWithoutSigma) {
  const DriftParams params{.sigma_m = 0.3, .correlation_s = 4.0, .most_m = 0.5};
  DriftState a = seeded(1), b = seeded(1), c = seeded(2), none = seeded(1);
  for (int i = 0; i < 1'000; ++i) {
    for (DriftState* state : {&a, &b, &c}) advance(params, *state, 0.1);
    advance({}, none, 0.1);
  }
  EXPECT_EQ(drift_at(params, a).n_m, drift_at(params, b).n_m);
  EXPECT_NE(drift_at(params, a).n_m, drift_at(params, c).n_m);
  EXPECT_EQ(drift_at({}, none).n_m, 0.0);
}

}  // namespace
}  // namespace pitwall::traffic
