// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/planning/speed_reference.hpp"

#include <algorithm>
#include <cmath>

namespace pitwall::planning {
namespace {

constexpr double kLandingShare = 0.8;  // of the jerk: the rest lets the landing law be followed

}  // namespace

double landing_mps2(double speed_mps, const SpeedLimits& limits, double dt_s) {
  const double error = limits.target_mps - speed_mps;
  const double size =
      std::min(std::sqrt(2.0 * kLandingShare * limits.jerk_max_mps3 * std::abs(error)),
               std::abs(error) / dt_s);
  return limits.target_accel_mps2 + std::copysign(size, error);
}

SpeedReference advance(const SpeedReference& r, const SpeedLimits& limits, double dt_s) {
  if (!(dt_s > 0.0)) return r;
  const double wanted = std::clamp(landing_mps2(r.speed_mps, limits, dt_s), -limits.decel_max_mps2,
                                   limits.accel_max_mps2);
  const double change = limits.jerk_max_mps3 * dt_s;
  const double accel = r.accel_mps2 + std::clamp(wanted - r.accel_mps2, -change, change);
  const double speed = r.speed_mps + 0.5 * (r.accel_mps2 + accel) * dt_s;
  if (speed <= 0.0) return {0.0, std::max(accel, 0.0)};
  return {speed, accel};
}

}  // namespace pitwall::planning
