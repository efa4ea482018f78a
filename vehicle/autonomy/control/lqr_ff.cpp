// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/control/lqr_ff.hpp"

#include <algorithm>
#include <cmath>

#include "protocol/vocabulary/check.hpp"

namespace pitwall::control {
namespace {

using PathError = std::array<double, 4>;  // e1, e1', e2, e2'

double share_of(double time_s) { return 1.0 - std::exp(-kLqrTick.seconds() / time_s); }

// Slip angle beyond the steady one of the path.
double slip_error_rad(const steering::Params& p, const LqrGains& gains, LqrState& state,
                      double seen_rad, double turn_error_rad_per_s, double v_mps) {
  const double lag_s = gains.rear_slip_rad_per_mps2 * v_mps;
  const double asked_rad = (p.bicycle.cg_to_rear_m / v_mps - lag_s) * turn_error_rad_per_s;
  state.model_slip_rad += share_of(lag_s) * (asked_rad - state.model_slip_rad);
  const double beyond_rad = seen_rad - state.model_slip_rad;
  state.slip_offset_rad += share_of(gains.slip_s) * (beyond_rad - state.slip_offset_rad);
  return seen_rad - state.slip_offset_rad;
}

PathError path_error(const steering::Params& p, const LqrGains& gains,
                     const steering::Learned& learned, LqrState& state, const LqrInputs& in,
                     double v_mps) {
  const steering::Deviation& at = in.path.deviation;
  const double cos_bank = std::cos(at.bank_rad);
  const double steady_rad =
      steering::slip_rad(p.bicycle, learned, {v_mps, at.curvature_per_m, at.bank_rad});
  const double seen_rad = (in.slip_mps / v_mps - steady_rad) * cos_bank;
  const double turn_error_rad_per_s =
      in.path.yaw_rate_rad_per_s / cos_bank - v_mps * in.path.ahead.yaw_per_m_here;
  const double slip_rad = slip_error_rad(p, gains, state, seen_rad, turn_error_rad_per_s, v_mps);
  return {at.lateral_m, v_mps * at.course_rad, at.course_rad - slip_rad, turn_error_rad_per_s};
}

double regulated_rad(const LqrGain& gain, const LqrState& state, const PathError& error) {
  double sum_rad = gain.wheel * state.wheel_rad;
  for (std::size_t i = 0; i < error.size(); ++i) sum_rad += gain.error[i] * error[i];
  for (std::size_t i = 0; i < state.sent_rad.size(); ++i)
    sum_rad += gain.sent[i] * state.sent_rad[i];
  return -sum_rad;
}

void send(const LqrGains& gains, LqrState& state, double u_rad) {
  state.wheel_rad += gains.wheel_share * (state.sent_rad[gains.delay_ticks - 1] - state.wheel_rad);
  std::copy_backward(state.sent_rad.begin(), state.sent_rad.end() - 1, state.sent_rad.end());
  state.sent_rad.front() = u_rad;
}

}  // namespace

double steer_lqr(const steering::Params& p, const LqrGains& gains, const steering::Learned& learned,
                 LqrState& state, const LqrInputs& in, Duration dt) {
  CHECK(gains.delay_ticks > 0);
  const steering::Deviation& at = in.path.deviation;
  const double v_mps = std::max(in.path.speed_mps, p.gain_speed_least_mps);
  const double demand_mps2 =
      steering::lateral_demand_mps2({v_mps, at.curvature_per_m, at.bank_rad});
  const double scale = steering::angle_per_curvature_m(p, learned, v_mps, demand_mps2) /
                       steering::angle_per_curvature_m(p, {}, v_mps, demand_mps2);
  const LqrGain gain = gain_at(gains, v_mps);
  LqrState next = state;
  const double u_rad = regulated_rad(gain, state, path_error(p, gains, learned, next, in, v_mps));
  const steering::Steered steered =
      steering::steer(p, learned, next.path, in.path,
                      {.angle_rad = scale * u_rad,
                       .unknown_rad = in.lap_rad,
                       .trim_rad_per_s = -gains.trim_per_s * scale * gain.error[0] * at.lateral_m},
                      dt);
  if (steered.following)
    send(gains, next, u_rad + steered.cut_rad / scale);
  else
    next = {.path = next.path};
  state = next;
  return steered.angle_rad;
}

}  // namespace pitwall::control
