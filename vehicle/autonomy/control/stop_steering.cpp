// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/control/stop_steering.hpp"

#include <algorithm>
#include <cmath>

#include "vehicle/autonomy/control/preview.hpp"

namespace pitwall::control {
namespace {

using world::EgoState;
using world::TrajectoryPoint;

constexpr double kTickMax_s = 0.05;        // a longer pause is no longer integration step
constexpr double kSteeringLag_s = 0.1;     // command to yaw rate: delay, actuator, tyres
constexpr double kObserveFrom_mps = 10.0;  // below, a yaw rate over a speed says little

double model_rad(const BicycleParams& car, double curvature_per_m, double speed_mps,
                 double bank_rad) {
  const double length_m = car.cg_to_front_m + car.cg_to_rear_m;
  const double lateral_mps2 =
      speed_mps * speed_mps * curvature_per_m - kGravity_mps2 * std::sin(bank_rad);
  return length_m * curvature_per_m + understeer_rad_per_mps2(car) * lateral_mps2;
}

double angle_per_curvature_m(const BicycleParams& car, double speed_mps) {
  return car.cg_to_front_m + car.cg_to_rear_m +
         understeer_rad_per_mps2(car) * speed_mps * speed_mps;
}

struct Errors {
  double e_m, heading_rad, course_rad;
};

Errors errors_at(const TrajectoryPoint& p, const EgoState& ego) {
  const double dx_m = ego.x_m - p.x_m, dy_m = ego.y_m - p.y_m;
  const double heading_rad = wrap_pi(ego.yaw_rad - p.yaw_rad);
  const double drift_rad = std::atan2(ego.vy_mps * std::cos(p.bank_rad), std::max(ego.vx_mps, 1.0));
  return {-dx_m * std::sin(p.yaw_rad) + dy_m * std::cos(p.yaw_rad), heading_rad,
          heading_rad + drift_rad};
}

double share_of(double dt_s, double time_s) { return 1.0 - std::exp(-dt_s / time_s); }

}  // namespace

double understeer_rad_per_mps2(const BicycleParams& car) {
  const double length_m = car.cg_to_front_m + car.cg_to_rear_m;
  return car.mass_kg / length_m *
         (car.cg_to_rear_m / car.cornering_front_n_per_rad -
          car.cg_to_front_m / car.cornering_rear_n_per_rad);
}

void observe(const StopSteeringParams& params, const BicycleParams& car, StopSteering& state,
             double last_angle_rad, const EgoState& ego, double bank_rad, Duration dt) {
  const double dt_s = std::clamp(dt.seconds(), 0.0, kTickMax_s);
  state.commanded_rad += share_of(dt_s, kSteeringLag_s) * (last_angle_rad - state.commanded_rad);
  if (!is_usable(ego)) return;
  double seen_rad = 0.0;
  if (ego.vx_mps > kObserveFrom_mps) {
    const double curvature_per_m = ego.yaw_rate_rad_per_s / ego.vx_mps;
    seen_rad = state.commanded_rad - model_rad(car, curvature_per_m, ego.vx_mps, bank_rad);
    seen_rad = std::clamp(seen_rad, -params.correction_max_rad, params.correction_max_rad);
  }
  state.unknown_rad += share_of(dt_s, params.observer_s) * (seen_rad - state.unknown_rad);
}

LateralDiagnostics steer_stop(const StopSteeringParams& p, const LateralParams& lateral,
                              const BicycleParams& car, StopSteering& state, double last_angle_rad,
                              const EgoState& ego, const world::Trajectory& trajectory,
                              Duration dt) {
  LateralDiagnostics out;
  out.angle_rad = last_angle_rad;
  if (!is_usable(ego)) return out.verdict = LateralVerdict::kNoEgo, out;
  const auto here = project(trajectory, ego.x_m, ego.y_m);
  if (!here) return out.verdict = LateralVerdict::kNoTrajectory, out;

  const double v_mps = std::max(ego.vx_mps, 0.0),
               gain_mps = std::max(v_mps, p.gain_speed_least_mps);
  const TrajectoryPoint ahead = at(trajectory, *here + v_mps * p.preview_s);
  const Errors e = errors_at(at(trajectory, *here), ego);
  out.cross_track_m = out.e1_m = e.e_m;
  out.heading_error_rad = out.e2_rad = e.heading_rad;
  out.bracket = static_cast<std::uint8_t>(bracket_of(v_mps));

  const double w = p.bandwidth_rad_per_s, per_curvature_m = angle_per_curvature_m(car, gain_mps);
  const double feedback_per_m =
      -(w * w * e.e_m + 2.0 * p.damping * w * gain_mps * e.course_rad) / (gain_mps * gain_mps);
  const double known_rad =
      model_rad(car, ahead.curvature_per_m * std::cos(ahead.bank_rad), v_mps, ahead.bank_rad) +
      per_curvature_m * feedback_per_m + state.unknown_rad;
  if (!std::isfinite(known_rad)) return out.verdict = LateralVerdict::kNoTrajectory, out;
  if (!state.active) {
    state.active = true;
    state.trim_rad = 0.0;
    state.bump_rad = last_angle_rad - known_rad;
  }
  out.verdict =
      std::abs(e.e_m) <= lateral.deviation_max_m ? LateralVerdict::kGood : LateralVerdict::kTooFar;
  if (v_mps < p.hold_speed_mps) return out;  // the wheels would turn on the spot

  const double dt_s = std::clamp(dt.seconds(), 0.0, kTickMax_s);
  const double trim_per_m = per_curvature_m * w * w / (gain_mps * gain_mps);
  state.trim_rad = std::clamp(state.trim_rad - p.trim_per_s * trim_per_m * e.e_m * dt_s,
                              -p.correction_max_rad, p.correction_max_rad);
  state.bump_rad -= share_of(dt_s, p.settle_s) * state.bump_rad;
  const double raw_rad = known_rad + state.trim_rad + state.bump_rad;
  out.angle_rad = std::clamp(raw_rad, -lateral.angle_max_rad, lateral.angle_max_rad);
  out.saturated = out.angle_rad != raw_rad;
  return out;
}

}  // namespace pitwall::control
