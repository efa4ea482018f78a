// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/control/lqr_ff.hpp"

#include <algorithm>
#include <cmath>

#include "protocol/vocabulary/check.hpp"

namespace pitwall::control {
namespace {

using PathError = std::array<double, 4>;  // e1, e1', e2, e2'

PathError path_error(const steering::Params& p, const steering::Learned& learned,
                     const LqrInputs& in, double v_mps) {
  const steering::Deviation& at = in.path.deviation;
  const double cos_bank = std::cos(at.bank_rad);
  const double steady_rad =
      steering::slip_rad(p.bicycle, learned, {v_mps, at.curvature_per_m, at.bank_rad});
  const double slip_rad = in.slip_mps / v_mps - steady_rad;
  return {at.lateral_m, v_mps * at.course_rad, at.course_rad - slip_rad * cos_bank,
          in.path.yaw_rate_rad_per_s / cos_bank - v_mps * in.path.ahead.yaw_per_m_here};
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
  CHECK(gains.delay_ticks >= 1 && gains.delay_ticks <= kLqrDelayTicks);
  const steering::Deviation& at = in.path.deviation;
  const double v_mps = std::max(in.path.speed_mps, p.gain_speed_least_mps);
  const double demand_mps2 =
      steering::lateral_demand_mps2({v_mps, at.curvature_per_m, at.bank_rad});
  const double scale = steering::angle_per_curvature_m(p, learned, v_mps, demand_mps2) /
                       steering::angle_per_curvature_m(p, {}, v_mps, 0.0);
  const LqrGain gain = gain_at(gains, v_mps);
  const double u_rad = regulated_rad(gain, state, path_error(p, learned, in, v_mps));
  const steering::Steered steered =
      steering::steer(p, learned, state.path, in.path,
                      {.angle_rad = scale * u_rad,
                       .trim_rad_per_s = -gains.trim_per_s * scale * gain.error[0] * at.lateral_m},
                      dt);
  if (steered.following)
    send(gains, state, u_rad + steered.cut_rad / scale);
  else
    state.sent_rad = {}, state.wheel_rad = 0.0;
  return steered.angle_rad;
}

LateralDiagnostics steer_lqr(const steering::Params& params, const LqrGains& gains,
                             const LateralParams& lateral, const steering::Learned& learned,
                             LqrState& state, const Angles& angles, const world::EgoState& ego,
                             const world::Trajectory& trajectory, Duration dt) {
  const OnPath path = on_path(params, lateral, learned, angles, ego, trajectory);
  if (!path.is_usable()) return path.diagnostics;
  return steered(path, steer_lqr(params, gains, learned, state,
                                 {.path = path.in, .slip_mps = ego.vy_mps}, dt));
}

}  // namespace pitwall::control
