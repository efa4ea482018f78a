// SPDX-License-Identifier: Apache-2.0
#include "hil/plant/compliant/brush_tyre.hpp"

#include <algorithm>
#include <cmath>

namespace pitwall::plant {
namespace {

// Stiffness over that at nominal load: sin(2 atan(x)) is 2 x / (1 + x^2).
double stiffening(const Tyre& tyre, const Brush& brush, double load_n) {
  const double nominal = 1.0 / brush.stiffest_load;
  const double x = nominal * load_n / tyre.nominal_load_n;
  return load_n / tyre.nominal_load_n * (1.0 + nominal * nominal) / (1.0 + x * x);
}

struct Slipping {
  double long_rho, lat_rho, rho;
};

// The slip at which all of the patch slides goes with friction, and with load over stiffness.
Slipping slipping(const Tyre& tyre, const Brush& brush, const TyreSlip& slip, double load_n,
                  double grip) {
  constexpr double kLeast = 1e-6;  // of the scale, where there is no friction
  const double share = lat_limit_n(tyre, load_n, grip) / (tyre.mu_lat * tyre.nominal_load_n);
  const double stiffness = stiffening(tyre, brush, load_n);
  const double scale = load_n > 0.0 ? std::max(kLeast, share / stiffness) : 1.0;
  const double along = slip.ratio / (tyre.peak_slip_ratio * scale);
  const double across = slip.sine / (std::sin(tyre.peak_slip_angle_rad) * scale);
  return {along, across, std::sqrt(along * along + across * across)};
}

}  // namespace

TyreForce brush_force(const Tyre& tyre, const Brush& brush, const TyreSlip& slip, double load_n,
                      double grip) {
  const Slipping s = slipping(tyre, brush, slip, load_n, grip);
  double per_rho = 3.0 - 3.0 * s.rho + s.rho * s.rho, use = per_rho * s.rho;
  if (s.rho >= 1.0) {
    const double beyond = (s.rho - 1.0) / brush.sliding_slips;
    const double slid = brush.sliding_friction;
    per_rho = (slid + (1.0 - slid) / (1.0 + beyond * beyond)) / s.rho;
    use = 1.0;
  }
  return {.long_n = long_limit_n(tyre, load_n, grip) * per_rho * s.long_rho,
          .lat_n = lat_limit_n(tyre, load_n, grip) * per_rho * s.lat_rho,
          .use = use};
}

double pneumatic_trail_m(const Tyre& tyre, const Brush& brush, const TyreSlip& slip, double load_n,
                         double grip) {
  const double rho = slipping(tyre, brush, slip, load_n, grip).rho;
  if (rho >= 1.0) return 0.0;
  const double sticking = 1.0 - rho;
  // The patch is as long as the root of the load.
  return brush.trail_m * std::sqrt(load_n / tyre.nominal_load_n) * sticking * sticking * sticking /
         (sticking + rho * rho / 3.0);
}

double brush_long_stiffness_n(const Tyre& tyre, const Brush& brush, double load_n) {
  return 3.0 * tyre.mu_long * tyre.nominal_load_n / tyre.peak_slip_ratio *
         stiffening(tyre, brush, load_n);
}

double brush_lat_stiffness_n(const Tyre& tyre, const Brush& brush, double load_n) {
  return 3.0 * tyre.mu_lat * tyre.nominal_load_n / std::sin(tyre.peak_slip_angle_rad) *
         stiffening(tyre, brush, load_n);
}

}  // namespace pitwall::plant
