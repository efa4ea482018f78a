// SPDX-License-Identifier: Apache-2.0
#include "vehicle/steering/angle_limits.hpp"

#include <algorithm>
#include <cmath>

namespace pitwall::steering {
namespace {

// a v^2 + b v + c <= 0 where it rises through zero: the larger root within (low, high), if any.
double root_within(double a, double b, double c, double low_mps, double high_mps) {
  constexpr double kFlat = 1e-12;
  if (std::abs(a) < kFlat)
    return std::abs(b) < kFlat ? low_mps : std::clamp(-c / b, low_mps, high_mps);
  const double inside = std::max(b * b - 4.0 * a * c, 0.0);
  const double larger = (-b + std::sqrt(inside)) / (2.0 * a);
  return std::clamp(larger, low_mps, high_mps);
}

}  // namespace

double angle_max_rad(const AngleLimits& limits, double speed_mps) {
  if (!(speed_mps < limits.back().speed_mps)) return limits.back().angle_rad;
  if (speed_mps <= limits.front().speed_mps) return limits.front().angle_rad;
  std::size_t i = 1;
  while (limits[i].speed_mps < speed_mps) ++i;
  const AngleRow &a = limits[i - 1], &b = limits[i];
  return a.angle_rad +
         (speed_mps - a.speed_mps) / (b.speed_mps - a.speed_mps) * (b.angle_rad - a.angle_rad);
}

double fastest_mps(const AngleBudget& budget, double curvature_per_m, double bank_rad) {
  const AngleLimits& rows = budget.limits;
  const double way = curvature_per_m < 0.0 ? -1.0 : 1.0;
  const double turn_per_m = std::abs(curvature_per_m) * std::cos(bank_rad);
  const double gradient = std::max(budget.understeer_rad_per_mps2, 0.0);
  // Angle needed: fixed + gradient turn v^2.
  const double fixed_rad = budget.wheelbase_m * turn_per_m + way * budget.offset_rad -
                           gradient * kGravity_mps2 * way * std::sin(bank_rad);
  const auto spare_rad = [&](const AngleRow& row) {
    return budget.share * row.angle_rad - fixed_rad -
           gradient * turn_per_m * row.speed_mps * row.speed_mps;
  };
  if (spare_rad(rows.back()) >= 0.0) return rows.back().speed_mps;
  for (std::size_t i = rows.size() - 1; i > 0; --i) {
    const AngleRow &low = rows[i - 1], &high = rows[i];
    if (spare_rad(low) < 0.0) continue;
    const double slope =
        budget.share * (high.angle_rad - low.angle_rad) / (high.speed_mps - low.speed_mps);
    const double at_zero_rad = budget.share * low.angle_rad - slope * low.speed_mps;
    return root_within(gradient * turn_per_m, -slope, fixed_rad - at_zero_rad, low.speed_mps,
                       high.speed_mps);
  }
  return 0.0;
}

}  // namespace pitwall::steering
