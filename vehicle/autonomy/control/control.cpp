// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/control/control.hpp"

#include <array>
#include <cmath>

#include "vehicle/autonomy/control/preview.hpp"
#include "vehicle/world/legal_range.hpp"

namespace pitwall::control {
namespace {

using world::LegalRange;

std::optional<Problem> illegal_car(const BicycleParams& c, const LateralParams& l) {
  return world::first_illegal(std::array{
      LegalRange{"bicycle.mass_kg", c.mass_kg, 300, 2000},
      LegalRange{"bicycle.yaw_inertia_kg_m2", c.yaw_inertia_kg_m2, 200, 5000},
      LegalRange{"bicycle.cg_to_front_m", c.cg_to_front_m, 0.5, 3},
      LegalRange{"bicycle.cg_to_rear_m", c.cg_to_rear_m, 0.5, 3},
      LegalRange{"bicycle.cornering_front_n_per_rad", c.cornering_front_n_per_rad, 2e4, 1e6},
      LegalRange{"bicycle.cornering_rear_n_per_rad", c.cornering_rear_n_per_rad, 2e4, 1e6},
      LegalRange{"lateral.lookahead_base_m", l.lookahead_base_m, 0, 30},
      LegalRange{"lateral.lookahead_per_speed_s", l.lookahead_per_speed_s, 0, 1},
      LegalRange{"lateral.angle_max_rad", l.angle_max_rad, 0.02, 0.3},
      LegalRange{"lateral.gain_speed_floor_mps", l.gain_speed_floor_mps, 1, 10},
      LegalRange{"lateral.deviation_max_m", l.deviation_max_m, 1, 20}});
}

std::optional<Problem> illegal_longitudinal(const LongitudinalParams& p) {
  return world::first_illegal(std::array{
      LegalRange{"longitudinal.kp_per_mps", p.kp_per_mps, 0.01, 2},
      LegalRange{"longitudinal.feedforward_per_mps", p.feedforward_per_mps, 0, 0.05},
      LegalRange{"longitudinal.brake_kpa_per_command", p.brake_kpa_per_command, 100, 20000},
      LegalRange{"longitudinal.speed_preview_s", p.speed_preview_s, 0, 1},
      LegalRange{"longitudinal.throttle_max", p.throttle_max, 0, 1},
      LegalRange{"longitudinal.throttle_rise_per_s", p.throttle_rise_per_s, 0.1, 20},
      LegalRange{"longitudinal.throttle_fall_per_s", p.throttle_fall_per_s, 0.1, 100},
      LegalRange{"longitudinal.brake_max_kpa", p.brake_max_kpa, 500, 9000},
      LegalRange{"longitudinal.brake_rise_kpa_per_s", p.brake_rise_kpa_per_s, 500, 50000},
      LegalRange{"longitudinal.brake_fall_kpa_per_s", p.brake_fall_kpa_per_s, 500, 50000},
      LegalRange{"longitudinal.hold_speed_mps", p.hold_speed_mps, 0.1, 2},
      LegalRange{"longitudinal.hold_brake_kpa", p.hold_brake_kpa, 100, 3000}});
}

std::optional<Problem> illegal_gear(const GearParams& p) {
  for (std::size_t i = 0; i < p.up_above_mps.size(); ++i) {
    const std::string index = "[" + std::to_string(i) + "]";
    const double least = i == 0 ? 0.0 : p.up_above_mps[i - 1];
    if (!(p.up_above_mps[i] > least && p.up_above_mps[i] < 150.0)) {
      return Problem{"gear.up_above_mps" + index, "must rise, within 0 and 150"};
    }
    if (!(p.down_below_mps[i] > 0.0 && p.down_below_mps[i] < p.up_above_mps[i])) {
      return Problem{"gear.down_below_mps" + index, "must be below the speed of the shift up"};
    }
  }
  return world::first_illegal(std::array{LegalRange{"gear.dwell_s", p.dwell_s, 0.2, 5}});
}

std::optional<Problem> illegal_stop(const StopSteeringParams& s, const StopSpeedParams& v) {
  return world::first_illegal(
      std::array{LegalRange{"stop_steering.bandwidth_rad_per_s", s.bandwidth_rad_per_s, 0.5, 6},
                 LegalRange{"stop_steering.damping", s.damping, 0.5, 1.5},
                 LegalRange{"stop_steering.preview_s", s.preview_s, 0, 0.5},
                 LegalRange{"stop_steering.observer_s", s.observer_s, 0.05, 5},
                 LegalRange{"stop_steering.trim_per_s", s.trim_per_s, 0, 2},
                 LegalRange{"stop_steering.settle_s", s.settle_s, 0.1, 5},
                 LegalRange{"stop_steering.correction_max_rad", s.correction_max_rad, 0, 0.1},
                 LegalRange{"stop_steering.gain_speed_least_mps", s.gain_speed_least_mps, 2, 20},
                 LegalRange{"stop_steering.hold_speed_mps", s.hold_speed_mps, 0.1, 5},
                 LegalRange{"stop_speed.kpa_per_mps2", v.kpa_per_mps2, 50, 1000},
                 LegalRange{"stop_speed.coast_mps2", v.coast_mps2, 0, 3},
                 LegalRange{"stop_speed.drag_per_m", v.drag_per_m, 0, 0.01},
                 LegalRange{"stop_speed.speed_share_per_s", v.speed_share_per_s, 0, 3},
                 LegalRange{"stop_speed.preview_s", v.preview_s, 0, 0.5},
                 LegalRange{"stop_speed.throttle_fall_per_s", v.throttle_fall_per_s, 0.2, 20},
                 LegalRange{"stop_speed.brake_rate_kpa_per_s", v.brake_rate_kpa_per_s, 500, 20000},
                 LegalRange{"stop_speed.hold_rate_kpa_per_s", v.hold_rate_kpa_per_s, 100, 20000}});
}

double target_speed(const LongitudinalParams& p, const world::EgoState& ego,
                    const world::Trajectory& trajectory) {
  const auto here = project(trajectory, ego.x_m, ego.y_m);
  if (!here) return kUnset;
  return at(trajectory, *here + std::max(ego.vx_mps, 0.0) * p.speed_preview_s).speed_mps;
}

StopTarget stop_target(const StopSpeedParams& p, const world::EgoState& ego,
                       const world::Trajectory& trajectory) {
  const auto here = project(trajectory, ego.x_m, ego.y_m);
  if (!here) return {};
  const double ahead_m = std::max(ego.vx_mps, 0.0) * p.preview_s;
  return {at(trajectory, *here).speed_mps, at(trajectory, *here + ahead_m).accel_mps2};
}

double bank_beside(const world::EgoState& ego, const world::Trajectory& trajectory) {
  const auto here = project(trajectory, ego.x_m, ego.y_m);
  return here ? at(trajectory, *here).bank_rad : 0.0;
}

// The observer runs whoever steers: the first tick of a stop finds it settled.
LateralDiagnostics steer(const Params& p, const LateralGains& gains, const Inputs& in,
                         double last_angle_rad, StopSteering& steering, Duration dt) {
  observe(p.stop_steering, p.bicycle, steering, last_angle_rad, in.ego,
          bank_beside(in.ego, in.trajectory), dt);
  const LateralLaw law = in.stopping ? p.stop_law : p.drive_law;
  if (law == LateralLaw::kFeedForward)
    return steer_stop(p.stop_steering, p.lateral, p.bicycle, steering, last_angle_rad, in.ego,
                      in.trajectory, dt);
  steering.active = false;
  return steer(p.lateral, gains, last_angle_rad, in.ego, in.trajectory);
}

LongitudinalOutput drive(const Params& p, const State& state, const Inputs& in, bool following,
                         Duration dt) {
  if (in.stopping)
    return slow(p.stop_speed, p.longitudinal, state.longitudinal,
                following ? stop_target(p.stop_speed, in.ego, in.trajectory) : StopTarget{},
                in.ego.vx_mps, dt);
  const double target = following ? target_speed(p.longitudinal, in.ego, in.trajectory) : kUnset;
  return step(p.longitudinal, state.longitudinal, target, in.ego.vx_mps, dt);
}

}  // namespace

Result<LateralGains, Problem> prepare(const Params& params) {
  if (auto problem = illegal_car(params.bicycle, params.lateral)) return Unexpected{*problem};
  if (auto problem = illegal_longitudinal(params.longitudinal)) return Unexpected{*problem};
  if (auto problem = illegal_stop(params.stop_steering, params.stop_speed))
    return Unexpected{*problem};
  if (auto problem = illegal_gear(params.gear)) return Unexpected{*problem};
  return design(params.lateral, params.bicycle);
}

Output step(const Params& params, const LateralGains& gains, const State& state, const Inputs& in,
            Instant now, Duration dt) {
  Output out;
  out.next.steering = state.steering;
  out.lateral = steer(params, gains, in, state.road_wheel_rad, out.next.steering, dt);
  const bool following = out.lateral.verdict == LateralVerdict::kGood ||
                         out.lateral.verdict == LateralVerdict::kTooFar;
  const LongitudinalOutput longitudinal = drive(params, state, in, following, dt);
  out.target_speed_mps = longitudinal.target_speed_mps;
  out.next.road_wheel_rad = out.lateral.angle_rad;
  out.next.longitudinal = longitudinal.next;
  out.next.gear = step(params.gear, state.gear, in.ego.vx_mps, now);
  out.command = {.at = now,
                 .road_wheel_rad = out.next.road_wheel_rad,
                 .throttle_fraction = out.next.longitudinal.throttle_fraction,
                 .brake_kpa = out.next.longitudinal.brake_kpa,
                 .gear = out.next.gear.gear};
  return out;
}

}  // namespace pitwall::control
