// SPDX-License-Identifier: Apache-2.0
#include "vehicle/safety/safe_stop.hpp"

#include <algorithm>
#include <cmath>

namespace pitwall::safety {
namespace {

using world::ActuatorCommand;
using world::Trajectory;
using world::TrajectoryPoint;

constexpr double kTickMax_s = 0.1;  // a longer pause does not jump along the path
constexpr double kRelease = 2.0;    // the brake is let go at twice the ramp

double finite_or(double value, double fallback) { return std::isfinite(value) ? value : fallback; }

// What the trajectory asks at a distance: of its first point before it, of its last behind it.
struct Wanted {
  double curvature_per_m, bank_rad, accel_mps2;
};

Wanted wanted_at(const Trajectory& path, double s_m) {
  const auto& points = path.points;
  std::size_t i = 1;
  while (i < points.size() && points[i].s_m < s_m) ++i;
  const TrajectoryPoint& b = i < points.size() ? points[i] : points.back();
  const TrajectoryPoint& a = points[i - 1];
  const double length_m = b.s_m - a.s_m;
  const double share = length_m > 0.0 ? std::clamp((s_m - a.s_m) / length_m, 0.0, 1.0) : 0.0;
  const auto between = [share](double from, double to) { return from + share * (to - from); };
  return {finite_or(between(a.curvature_per_m, b.curvature_per_m), 0.0),
          finite_or(between(a.bank_rad, b.bank_rad), 0.0),
          finite_or(between(a.accel_mps2, b.accel_mps2), 0.0)};
}

// delta = L k + K_us (v^2 k - g sin(bank))
double feedforward_rad(const SafeStopParams& params, double speed_mps, const Wanted& w) {
  const Grip grip = grip_at(params, speed_mps, w.curvature_per_m, w.bank_rad);
  return params.wheelbase_m * w.curvature_per_m +
         params.understeer_rad_per_mps2 * grip.lateral_mps2;
}

SafeStopState begin(const SafeStopParams& params, const SafeStopInputs& in, Instant now) {
  SafeStopState s;
  s.active = true;
  s.begun = s.last = now;
  const double last_good_rad = finite_or(in.last_good.road_wheel_rad, 0.0);
  s.brake_kpa = std::max(0.0, finite_or(in.last_good.brake_kpa, 0.0));
  s.steer_offset_rad = last_good_rad;
  s.speed_mps = std::max(0.0, finite_or(in.speed_mps, 0.0));
  if (in.stop.points.empty()) return s;
  if (!std::isfinite(in.speed_mps))
    s.speed_mps = std::max(0.0, finite_or(in.stop.points[0].speed_mps, 0.0));
  s.travelled_m = std::max(0.0, (now - in.stop.at).seconds()) * s.speed_mps;
  const Wanted w = wanted_at(in.stop, s.travelled_m);
  s.steer_offset_rad = last_good_rad - feedforward_rad(params, s.speed_mps, w);
  return s;
}

void advance(const SafeStopParams& params, SafeStopState& s, double measured_mps, double dt_s) {
  const double decel_mps2 = s.brake_kpa / params.brake_kpa_per_mps2;
  const double reckoned_mps = std::max(0.0, s.speed_mps - decel_mps2 * dt_s);
  s.speed_mps = std::max(0.0, finite_or(measured_mps, reckoned_mps));
  s.travelled_m += s.speed_mps * dt_s;
}

double decel_of(const SafeStopParams& params, const SafeStopInputs& in, const Wanted& w) {
  if (in.kind == StopKind::kEmergency) return params.emergency_decel_mps2;
  if (in.stop.points.empty()) return params.decel_without_plan_mps2;
  return std::clamp(-w.accel_mps2, params.decel_min_mps2, params.decel_max_mps2);
}

double ramp_of(const SafeStopParams& params, StopKind kind) {
  return kind == StopKind::kEmergency ? params.emergency_ramp_kpa_per_s
                                      : params.brake_ramp_kpa_per_s;
}

double ramped(double last_kpa, double target_kpa, double ramp_kpa_per_s, double dt_s) {
  return std::clamp(target_kpa, last_kpa - kRelease * ramp_kpa_per_s * dt_s,
                    last_kpa + ramp_kpa_per_s * dt_s);
}

double grip_left_mps2(const SafeStopParams& params, StopKind kind, const Grip& grip) {
  const bool emergency = kind == StopKind::kEmergency;
  const double share = emergency ? params.emergency_grip_share : params.grip_share;
  const double total = grip.total_mps2, lateral = grip.lateral_mps2;
  return share * std::sqrt(std::max(0.0, total * total - lateral * lateral));
}

}  // namespace

Grip grip_at(const SafeStopParams& params, double speed_mps, double curvature_per_m,
             double bank_rad) {
  const double centripetal_mps2 = speed_mps * speed_mps * curvature_per_m;
  const double normal_mps2 = kGravity_mps2 * std::cos(bank_rad) +
                             centripetal_mps2 * std::sin(bank_rad) +
                             params.downforce_per_m * speed_mps * speed_mps;
  return {params.friction * std::max(0.0, normal_mps2),
          centripetal_mps2 - kGravity_mps2 * std::sin(bank_rad)};
}

double brake_for(const SafeStopParams& params, StopKind kind, double decel_mps2, const Grip& grip) {
  const double left_mps2 = grip_left_mps2(params, kind, grip);
  return std::min(std::min(decel_mps2, left_mps2) * params.brake_kpa_per_mps2,
                  params.brake_max_kpa);
}

double brake_towards(const SafeStopParams& params, StopKind kind, const BrakeDemand& demand) {
  const double left_mps2 = grip_left_mps2(params, kind, demand.grip);
  const double decel_mps2 = std::max(params.decel_min_mps2, std::min(demand.decel_mps2, left_mps2));
  const double target_kpa = std::min(decel_mps2 * params.brake_kpa_per_mps2, params.brake_max_kpa);
  return ramped(demand.last_kpa, target_kpa, ramp_of(params, kind), demand.dt_s);
}

ActuatorCommand stop_along(const SafeStopParams& params, SafeStopState& state,
                           const SafeStopInputs& in, Instant now) {
  if (!state.active) state = begin(params, in, now);
  const double dt_s = std::clamp((now - state.last).seconds(), 0.0, kTickMax_s);
  state.last = now;
  advance(params, state, in.speed_mps, dt_s);

  const bool planned = !in.stop.points.empty();
  const Wanted w = planned ? wanted_at(in.stop, state.travelled_m) : Wanted{0.0, 0.0, 0.0};
  const double settled = planned ? std::exp(-(now - state.begun).seconds() / params.steer_settle_s)
                                 : 1.0;  // nothing to settle to: hold
  const double angle_rad = (planned ? feedforward_rad(params, state.speed_mps, w) : 0.0) +
                           state.steer_offset_rad * settled;

  if (state.speed_mps < params.standstill_mps) {
    state.brake_kpa = ramped(state.brake_kpa, params.hold_kpa, ramp_of(params, in.kind), dt_s);
  } else {
    const Grip grip = grip_at(params, state.speed_mps, w.curvature_per_m, w.bank_rad);
    state.brake_kpa = brake_towards(params, in.kind,
                                    {.decel_mps2 = decel_of(params, in, w),
                                     .grip = grip,
                                     .last_kpa = state.brake_kpa,
                                     .dt_s = dt_s});
  }
  return {.at = now,
          .road_wheel_rad = angle_rad,
          .throttle_fraction = 0.0,
          .brake_kpa = state.brake_kpa,
          .gear = in.last_good.gear};
}

}  // namespace pitwall::safety
