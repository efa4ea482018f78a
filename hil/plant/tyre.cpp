// SPDX-License-Identifier: Apache-2.0
#include "hil/plant/tyre.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pitwall::plant {
namespace {

// Friction falls linearly with load, down to a floor.
double load_share(const Tyre& t, double load_n) {
  const double relative = (load_n - t.nominal_load_n) / t.nominal_load_n;
  return std::max(t.mu_min_share, 1.0 - t.load_sensitivity * relative);
}

// B of sin(C atan(B rho)) that puts the peak at rho = 1.
double steepness(double shape) { return std::tan(std::numbers::pi / (2.0 * shape)); }

}  // namespace

TyreForce tyre_force(const Tyre& tyre, const TyreSlip& slip, double load_n, double grip) {
  const double long_rho = slip.ratio / tyre.peak_slip_ratio;
  const double lat_rho = slip.sine / std::sin(tyre.peak_slip_angle_rad);
  const double rho = std::hypot(long_rho, lat_rho);
  const double b = steepness(tyre.shape);
  constexpr double kTiny = 1e-9;  // below, the curve is its tangent
  const double curve = std::sin(tyre.shape * std::atan(b * rho));
  const double per_rho = rho > kTiny ? curve / rho : tyre.shape * b;
  const double scale_n = grip * load_share(tyre, load_n) * load_n * per_rho;
  return {.long_n = tyre.mu_long * scale_n * long_rho,
          .lat_n = tyre.mu_lat * scale_n * lat_rho,
          .use = rho < 1.0 ? curve : 1.0};
}

double long_stiffness_n(const Tyre& tyre, double load_n, double grip) {
  return grip * load_share(tyre, load_n) * load_n * tyre.mu_long * tyre.shape *
         steepness(tyre.shape) / tyre.peak_slip_ratio;
}

double lat_stiffness_n(const Tyre& tyre, double load_n, double grip) {
  return grip * load_share(tyre, load_n) * load_n * tyre.mu_lat * tyre.shape *
         steepness(tyre.shape) / std::sin(tyre.peak_slip_angle_rad);
}

double long_limit_n(const Tyre& tyre, double load_n, double grip) {
  return grip * load_share(tyre, load_n) * load_n * tyre.mu_long;
}

double lat_limit_n(const Tyre& tyre, double load_n, double grip) {
  return grip * load_share(tyre, load_n) * load_n * tyre.mu_lat;
}

}  // namespace pitwall::plant
