// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/control/stop_speed.hpp"

#include <algorithm>
#include <cmath>

namespace pitwall::control {
namespace {

constexpr double kPlannedStill_mps = 0.05;

}  // namespace

LongitudinalOutput slow(const StopSpeedParams& p, const LongitudinalParams& l,
                        const LongitudinalState& state, const StopTarget& target, double speed_mps,
                        Duration dt) {
  LongitudinalOutput out;
  out.target_speed_mps = target.speed_mps;
  double wanted_kpa = 0.0, rate_kpa_per_s = p.brake_rate_kpa_per_s;
  if (std::isfinite(target.speed_mps + target.accel_mps2 + speed_mps)) {
    const double decel_mps2 =
        -target.accel_mps2 + p.speed_share_per_s * (speed_mps - target.speed_mps);
    const double free_mps2 = p.coast_mps2 + p.drag_per_m * speed_mps * speed_mps;
    wanted_kpa = std::clamp((decel_mps2 - free_mps2) * p.kpa_per_mps2, 0.0, l.brake_max_kpa);
    out.raw_command = -decel_mps2;
    if (target.speed_mps < kPlannedStill_mps && speed_mps < l.hold_speed_mps) {
      wanted_kpa = std::max(wanted_kpa, l.hold_brake_kpa);
      rate_kpa_per_s = p.hold_rate_kpa_per_s;
    }
  }
  const double dt_s = std::max(dt.seconds(), 0.0), step_kpa = rate_kpa_per_s * dt_s;
  out.next.throttle_fraction =
      std::max(state.throttle_fraction - p.throttle_fall_per_s * dt_s, 0.0);
  out.next.brake_kpa =
      std::clamp(wanted_kpa, state.brake_kpa - step_kpa, state.brake_kpa + step_kpa);
  return out;
}

}  // namespace pitwall::control
