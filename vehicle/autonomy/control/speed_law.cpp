// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/control/speed_law.hpp"

#include <algorithm>
#include <cmath>

namespace pitwall::control {
namespace {

struct Span {
  double least, most;
};

// Of the acceleration along the path, by the tyres alone.
Span tyre_limits(const SpeedLawParams& p, const DrivetrainParams& drivetrain,
                 const SpeedInputs& in) {
  constexpr double kSlow_mps = 1.0;  // below it the yaw rate says nothing of a curvature
  const double v_mps = std::max(in.motion.speed_mps, 0.0);
  const double cos_bank = std::cos(in.bank_rad);
  const double curvature = v_mps > kSlow_mps ? in.yaw_rate_rad_per_s / (v_mps * cos_bank) : 0.0;
  const envelope::RoadLoad load{v_mps, curvature, in.bank_rad};
  const envelope::FrictionParams car = on_tyres(p.car, in.tyre_c);
  const double resistance = resistance_mps2(drivetrain, in.motion);
  return {-envelope::brake_available_mps2(car, load, p.grip_share) - resistance,
          envelope::traction_mps2(car, load, p.grip_share) - resistance};
}

double toward(double from, double to, const Span& per_tick) {
  return std::clamp(to, from + per_tick.least, from + per_tick.most);
}

// At their rates, one after the other.
LongitudinalState apply(const LongitudinalParams& p, const LongitudinalState& last, Pedals wanted,
                        double dt_s) {
  if (wanted.brake_kpa > 0.0) wanted.throttle_fraction = 0.0;
  LongitudinalState next;
  next.throttle_fraction =
      toward(last.throttle_fraction, last.brake_kpa > 0.0 ? 0.0 : wanted.throttle_fraction,
             {-p.throttle_fall_per_s * dt_s, p.throttle_rise_per_s * dt_s});
  next.brake_kpa = toward(last.brake_kpa, next.throttle_fraction > 0.0 ? 0.0 : wanted.brake_kpa,
                          {-p.brake_fall_kpa_per_s * dt_s, p.brake_rise_kpa_per_s * dt_s});
  return next;
}

}  // namespace

SpeedOutput step(const SpeedLawParams& p, const LongitudinalParams& limits, SpeedLawState& state,
                 const SpeedInputs& in, Duration dt) {
  SpeedOutput out;
  const double dt_s = std::max(dt.seconds(), 0.0);
  const double error_mps = in.reference_mps - in.motion.speed_mps;
  if (!std::isfinite(error_mps + in.planned_mps2)) {
    state = {};
    out.next = apply(limits, in.applied, {}, dt_s);
    return out;
  }
  if (in.reference_mps <= 0.0 && in.motion.speed_mps < limits.hold_speed_mps) {
    state = {};
    out.next = apply(limits, in.applied, {0.0, limits.hold_brake_kpa}, dt_s);
    return out;
  }
  if (!in.drives) state.integral_mps2 = 0.0;
  const DrivetrainParams drivetrain{p.car, p.brake_kpa_per_mps2, p.rolling_mps2, p.dead_zone_mps2};
  const double feedback_mps2 = std::clamp(p.kp_per_s * error_mps + state.integral_mps2,
                                          -p.feedback_max_mps2, p.feedback_max_mps2);
  const double asked_mps2 = in.planned_mps2 + feedback_mps2;
  const Span tyres = tyre_limits(p, drivetrain, in);
  const double wanted_mps2 = std::clamp(asked_mps2, tyres.least, std::max(tyres.least, tyres.most));

  Pedals pedals = pedals_for(drivetrain, in.motion, wanted_mps2, state.braking);
  state.braking = pedals.brake_kpa > 0.0;
  if (in.shifting && !state.braking) pedals.throttle_fraction = in.applied.throttle_fraction;
  pedals.throttle_fraction = std::min(pedals.throttle_fraction, limits.throttle_max);
  pedals.brake_kpa = std::min(pedals.brake_kpa, limits.brake_max_kpa);
  out.next = apply(limits, in.applied, pedals, dt_s);

  // Positive: more acceleration was asked for than comes.
  const double missing = (pedals.throttle_fraction - out.next.throttle_fraction) -
                         (pedals.brake_kpa - out.next.brake_kpa);
  const bool short_of =
      asked_mps2 > wanted_mps2 || missing > 0.0 || pedals.throttle_fraction >= limits.throttle_max;
  const bool beyond =
      asked_mps2 < wanted_mps2 || missing < 0.0 || pedals.brake_kpa >= limits.brake_max_kpa;
  const bool winds_up = (short_of && error_mps > 0.0) || (beyond && error_mps < 0.0);
  if (in.drives && !in.changed && !in.shifting && !winds_up)
    state.integral_mps2 = std::clamp(state.integral_mps2 + p.ki_per_s2 * error_mps * dt_s,
                                     -p.integral_max_mps2, p.integral_max_mps2);
  out.seen = {.wanted_mps2 = wanted_mps2,
              .integral_mps2 = state.integral_mps2,
              .grip_limited = asked_mps2 != wanted_mps2,
              .saturated = short_of || beyond};
  return out;
}

}  // namespace pitwall::control
