// SPDX-License-Identifier: Apache-2.0
#include "vehicle/steering/path_steering.hpp"

#include <algorithm>
#include <cmath>

namespace pitwall::steering {
namespace {

constexpr double kLeadFrom_mps = 25.0;     // below, the lead is less
constexpr double kObserveFrom_mps = 10.0;  // below, a yaw rate over a speed says little

double share_of(double dt_s, double time_s) { return 1.0 - std::exp(-dt_s / time_s); }

void observe(const Params& p, const Learned& learned, State& s, const Turning& at, double dt_s) {
  double seen_rad = 0.0;
  if (at.speed_mps > kObserveFrom_mps && std::isfinite(at.yaw_rate_rad_per_s))
    seen_rad = residual_rad(p.bicycle, learned, at);
  if (!std::isfinite(seen_rad)) return;
  seen_rad = std::clamp(p.observer_share * seen_rad, -p.correction_max_rad, p.correction_max_rad);
  s.unknown_rad += share_of(dt_s, p.observer_s) * (seen_rad - s.unknown_rad);
}

}  // namespace

double stray_m_rad_per_s2(const Params& p) {
  return p.stray_max_m * p.bicycle.wheelbase_m * p.bandwidth_rad_per_s * p.bandwidth_rad_per_s /
         (1.0 - p.observer_share);
}

double angle_per_curvature_m(const Params& p, const Learned& learned, double speed_mps,
                             double lateral_mps2) {
  const double model = p.bicycle.understeer_rad_per_mps2;
  const double gradient =
      model + p.gain_share * std::max(understeer_at(p.bicycle, learned, lateral_mps2) - model, 0.0);
  return p.bicycle.wheelbase_m + std::max(gradient, 0.0) * speed_mps * speed_mps;
}

double lag_s(const Params& p, const Learned& learned) { return p.learning.lag_s + learned.lag_s; }

double yaw_per_m(const Params& p, const Learned& learned, double speed_mps, const RoadPoint& at,
                 const RoadPoint& before, const RoadPoint& after, double span_m) {
  const auto slip_at = [&](const RoadPoint& point) {
    return slip_rad(p.bicycle, learned, {speed_mps, point.curvature_per_m, point.bank_rad});
  };
  return at.curvature_per_m - (slip_at(after) - slip_at(before)) / (2.0 * span_m);
}

double steer(const Params& p, const Learned& learned, State& s, const SteeringInputs& in,
             Duration dt) {
  const double speed_mps = std::max(in.speed_mps, 0.0);
  const double v_mps = std::max(speed_mps, p.gain_speed_least_mps);
  const Deviation& at = in.deviation;
  observe(p, learned, s, {speed_mps, in.yaw_rate_rad_per_s, at.bank_rad}, tick_s(dt));
  // A slow car turns at once, and its gyroscopes' noise would reach the wheel.
  const double lead_s = p.lead_s * std::min(v_mps / kLeadFrom_mps, 1.0);
  const double path_rate = v_mps * in.ahead.yaw_per_m_here;
  const double excess_rad_per_s = std::isfinite(in.yaw_rate_rad_per_s)
                                      ? in.yaw_rate_rad_per_s / std::cos(at.bank_rad) - path_rate
                                      : 0.0;
  const double w = in.bandwidth_share * p.bandwidth_rad_per_s,
               per_curvature_m = angle_per_curvature_m(
                   p, learned, v_mps,
                   lateral_demand_mps2({v_mps, at.curvature_per_m, at.bank_rad}));
  const double lateral_m = at.lateral_m + lead_s * v_mps * at.course_rad;
  const double course_rad = at.course_rad + lead_s * excess_rad_per_s;
  const double feedback_per_m =
      -(w * w * lateral_m + 2.0 * p.damping * w * v_mps * course_rad) / (v_mps * v_mps);
  const double trim_per_m = p.trim_per_s * per_curvature_m * w * w / (v_mps * v_mps);
  return steer(p, learned, s, in,
               {.angle_rad = per_curvature_m * feedback_per_m,
                .unknown_rad = s.unknown_rad,
                .trim_rad_per_s = -trim_per_m * at.lateral_m},
               dt)
      .angle_rad;
}

Steered steer(const Params& p, const Learned& learned, State& s, const SteeringInputs& in,
              const Feedback& feedback, Duration dt) {
  const double speed_mps = std::max(in.speed_mps, 0.0);
  const double forward_rad =
      angle_rad(p.bicycle, learned, {speed_mps, in.ahead.yaw_per_m, in.ahead.bank_rad});
  const double known_rad = forward_rad + feedback.angle_rad + feedback.unknown_rad;
  if (!std::isfinite(known_rad + in.deviation.curvature_per_m)) return {in.last_angle_rad};
  if (speed_mps < p.hold_speed_mps) {  // the wheels would turn on the spot
    s.begun = false;
    return {in.last_angle_rad};
  }
  if (!s.begun) {
    s.begun = true;
    s.trim_rad = 0.0;
    s.bump_rad = in.last_angle_rad - known_rad;
  }
  const double raw_rad = known_rad + s.trim_rad + s.bump_rad;
  const double angle_rad = std::clamp(raw_rad, -in.angle_max_rad, in.angle_max_rad);
  if (angle_rad == raw_rad)
    s.trim_rad = std::clamp(s.trim_rad + feedback.trim_rad_per_s * tick_s(dt),
                            -p.correction_max_rad, p.correction_max_rad);
  s.bump_rad -= share_of(tick_s(dt), p.settle_s) * s.bump_rad;
  return {angle_rad, angle_rad - raw_rad, true};
}

}  // namespace pitwall::steering
