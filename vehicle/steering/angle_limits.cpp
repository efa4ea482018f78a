// SPDX-License-Identifier: Apache-2.0
#include "vehicle/steering/angle_limits.hpp"

#include <algorithm>
#include <cmath>

#include "vehicle/steering/road_load.hpp"

namespace pitwall::steering {
namespace {

// `turn` as one to the left; `way` is -1 where it goes to the right.
bool is_slow_enough(const AngleBudget& b, const RoadLoad& turn, double way) {
  const double lateral_mps2 = lateral_demand_mps2(turn);
  const double doubt = doubt_rad(b.learning, b.car, b.learned, lateral_mps2);
  const double needed = b.car.wheelbase_m * turn_per_m(turn) + way * b.learned.offset_rad +
                        understeer_at(b.car, b.learned, lateral_mps2) * lateral_mps2 + doubt;
  return needed <= b.share * angle_max_rad(b.limits, turn.speed_mps) &&
         (doubt * turn.speed_mps * turn.speed_mps <= b.stray_m_rad_per_s2 || lateral_mps2 <= 0.0);
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

double fastest_mps(const AngleBudget& budget, double curvature_per_m, double bank_rad,
                   double most_mps) {
  constexpr double kClose_mps = 0.01;
  const double way = curvature_per_m < 0.0 ? -1.0 : 1.0;
  RoadLoad turn{most_mps, std::abs(curvature_per_m), way * bank_rad};
  const auto is_slow_enough_at = [&](double speed_mps) {
    turn.speed_mps = speed_mps;
    return is_slow_enough(budget, turn, way);
  };
  if (is_slow_enough_at(most_mps)) return most_mps;
  double slow_mps = 0.0, fast_mps = most_mps;
  while (fast_mps - slow_mps > kClose_mps) {
    const double middle_mps = 0.5 * (slow_mps + fast_mps);
    (is_slow_enough_at(middle_mps) ? slow_mps : fast_mps) = middle_mps;
  }
  return is_slow_enough_at(slow_mps) ? slow_mps : 0.0;
}

}  // namespace pitwall::steering
