// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/control/control.hpp"

#include <string>

#include "vehicle/world/legal_range.hpp"

namespace pitwall::control {
namespace {

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
  return world::first_illegal(kGearRanges, p, "gear.");
}

std::optional<Problem> illegal(const Params& p) {
  using world::first_illegal;
  if (p.controller.step == nullptr) return Problem{"controller", "is not set"};
  if (auto problem = first_illegal(kBicycleRanges, p.bicycle, "bicycle.")) return problem;
  if (auto problem = first_illegal(kLateralRanges, p.lateral, "lateral.")) return problem;
  if (auto problem = first_illegal(kLongitudinalRanges, p.longitudinal, "longitudinal."))
    return problem;
  if (auto problem = first_illegal(kLapRanges, p.lap, "lap.")) return problem;
  if (auto problem = first_illegal(kSpeedLawRanges, p.speed, "speed.")) return problem;
  if (auto problem = first_illegal(steering::kRanges, p.steering, "steering.")) return problem;
  if (auto problem =
          first_illegal(steering::kBicycleRanges, p.steering.bicycle, "steering.bicycle."))
    return problem;
  if (auto problem =
          first_illegal(steering::kLearningRanges, p.steering.learning, "steering.learning."))
    return problem;
  return illegal_gear(p.gear);
}

}  // namespace

Result<LateralGains, Problem> prepare(const Params& params) {
  if (auto problem = illegal(params)) return Unexpected{*problem};
  auto gains = design(params.lateral, params.bicycle);
  if (!gains) return gains;
  auto lqr = design(params.lqr_ff, params.bicycle);
  if (!lqr) return Unexpected{lqr.error()};
  gains->lqr_ff = *lqr;
  return gains;
}

Output step(const Params& params, const LateralGains& gains, const State& state, const Inputs& in,
            Instant now, Duration dt) {
  Output out;
  out.next = state;
  const Action action = params.controller.step(params, gains, out.next, in, dt);
  out.lateral = action.lateral;
  out.speed = action.speed;
  out.target_speed_mps = action.longitudinal.target_speed_mps;
  out.next.road_wheel_rad = action.lateral.angle_rad;
  out.next.longitudinal = action.longitudinal.next;
  out.next.gear = step(params.gear, state.gear,
                       {.speed_mps = in.ego.vx_mps,
                        .target_mps = out.target_speed_mps,
                        .report = in.gearbox,
                        .drives = in.drives},
                       now);
  out.command = {.at = now,
                 .road_wheel_rad = out.next.road_wheel_rad,
                 .throttle_fraction = out.next.longitudinal.throttle_fraction,
                 .brake_kpa = out.next.longitudinal.brake_kpa,
                 .gear = out.next.gear.gear};
  return out;
}

}  // namespace pitwall::control
