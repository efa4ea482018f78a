// SPDX-License-Identifier: Apache-2.0
#include "hil/traffic/lane_drift.hpp"

#include <algorithm>
#include <cmath>

namespace pitwall::traffic {
namespace {

constexpr double kKnotsPerCorrelation = 4.0;

double knot_s(const DriftParams& params) { return params.correlation_s / kKnotsPerCorrelation; }

double next_coefficient_m(const DriftParams& params, DriftState& state) {
  const double decay = std::exp(-1.0 / kKnotsPerCorrelation);
  // At a knot the weights are 1/6, 4/6, 1/6, which takes this share of the variance.
  const double kept = (18.0 + 16.0 * decay + 2.0 * decay * decay) / 36.0;
  const double sigma_m = params.sigma_m / std::sqrt(kept);
  const double next_m = decay * state.coefficients_m[3] +
                        sigma_m * std::sqrt(1.0 - decay * decay) * state.noise.normal();
  return std::clamp(next_m, -params.most_m, params.most_m);
}

}  // namespace

void advance(const DriftParams& params, DriftState& state, double dt_s) {
  if (!(params.sigma_m > 0.0)) return;
  state.phase += dt_s / knot_s(params);
  for (; state.phase >= 1.0; state.phase -= 1.0) {
    auto& c = state.coefficients_m;
    c = {c[1], c[2], c[3], next_coefficient_m(params, state)};
  }
}

Drift drift_at(const DriftParams& params, const DriftState& state) {
  const auto& c = state.coefficients_m;
  const double u = state.phase, v = 1.0 - u;
  const double n_m = (v * v * v * c[0] + (3.0 * u * u * u - 6.0 * u * u + 4.0) * c[1] +
                      (3.0 * v * v * v - 6.0 * v * v + 4.0) * c[2] + u * u * u * c[3]) /
                     6.0;
  const double rise_m = 0.5 * (-v * v * c[0] + (3.0 * u * u - 4.0 * u) * c[1] -
                               (3.0 * v * v - 4.0 * v) * c[2] + u * u * c[3]);
  return {n_m, rise_m / knot_s(params)};
}

double most_accel_mps2(const DriftParams& params) {
  return params.sigma_m > 0.0 ? 4.0 * params.most_m / (knot_s(params) * knot_s(params)) : 0.0;
}

}  // namespace pitwall::traffic
