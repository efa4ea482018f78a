// Slow wander of a car beside its line.
//   method uniform cubic B-spline whose coefficients are an Ornstein-Uhlenbeck process, one every
//          quarter of the correlation time, limited to +-most_m
//   invariants
//          |offset| <= most_m and |its second derivative| <= 64 most_m / correlation_s^2, since a
//          B-spline stays among its coefficients and their second differences; offset, rate and
//          acceleration are continuous
//          far below the limit the offset has the standard deviation sigma_m at the knots
//          begins at 0; deterministic by its seed; time stands where dt is 0
//   cost   O(1) for a step below a quarter of the correlation time; no allocation
//   source Uhlenbeck and Ornstein, Phys. Rev. 36 (1930); de Boor, A Practical Guide to Splines
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "hil/sensors/noise.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::traffic {

struct DriftParams {
  double sigma_m = 0.0;  // 0: no drift
  double correlation_s = 10.0;
  double most_m = 0.0;
};

struct DriftState {
  sensors::Noise noise{};
  std::array<double, 4> coefficients_m{};
  double phase = 0.0;  // [0, 1) from knot to knot
};

struct Drift {
  double n_m = 0.0, rate_mps = 0.0;
};

void advance(const DriftParams& params, DriftState& state, double dt_s);
Drift drift_at(const DriftParams& params, const DriftState& state);
double most_accel_mps2(const DriftParams& params);

}  // namespace pitwall::traffic
