// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/control/longitudinal.hpp"

#include <algorithm>
#include <cmath>

namespace pitwall::control {
namespace {

struct Slew {
  double rise_per_s, fall_per_s;
};

double toward(double from, double to, Slew slew, double dt_s) {
  return std::clamp(to, from - slew.fall_per_s * dt_s, from + slew.rise_per_s * dt_s);
}

}  // namespace

LongitudinalOutput step(const LongitudinalParams& p, const LongitudinalState& state,
                        double target_speed_mps, double speed_mps, Duration dt) {
  LongitudinalOutput out;
  out.target_speed_mps = target_speed_mps;
  double throttle = 0.0, brake = 0.0;
  if (std::isfinite(target_speed_mps) && std::isfinite(speed_mps)) {
    out.raw_command =
        p.kp_per_mps * (target_speed_mps - speed_mps) + p.feedforward_per_mps * target_speed_mps;
    throttle = std::clamp(out.raw_command, 0.0, p.throttle_max);
    brake = std::clamp(-out.raw_command * p.brake_kpa_per_command, 0.0, p.brake_max_kpa);
    const bool standing = target_speed_mps <= 0.0 && speed_mps < p.hold_speed_mps;
    if (standing) throttle = 0.0, brake = std::max(brake, p.hold_brake_kpa);
  }
  const double dt_s = std::max(dt.seconds(), 0.0);
  out.next.throttle_fraction = toward(state.throttle_fraction, throttle,
                                      {p.throttle_rise_per_s, p.throttle_fall_per_s}, dt_s);
  out.next.brake_kpa =
      toward(state.brake_kpa, brake, {p.brake_rise_kpa_per_s, p.brake_fall_kpa_per_s}, dt_s);
  return out;
}

}  // namespace pitwall::control
