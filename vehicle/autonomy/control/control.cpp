// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/control/control.hpp"

#include <array>
#include <cmath>

#include "vehicle/autonomy/control/feed_forward.hpp"
#include "vehicle/autonomy/control/preview.hpp"
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
  if (auto problem = first_illegal(kBicycleRanges, p.bicycle, "bicycle.")) return problem;
  if (auto problem = first_illegal(kLateralRanges, p.lateral, "lateral.")) return problem;
  if (auto problem = first_illegal(kLongitudinalRanges, p.longitudinal, "longitudinal."))
    return problem;
  if (auto problem = first_illegal(steering::kRanges, p.steering, "steering.")) return problem;
  if (auto problem =
          first_illegal(steering::kBicycleRanges, p.steering.bicycle, "steering.bicycle."))
    return problem;
  if (auto problem =
          first_illegal(steering::kLearningRanges, p.steering.learning, "steering.learning."))
    return problem;
  return illegal_gear(p.gear);
}

double target_speed(const LongitudinalParams& p, const world::EgoState& ego,
                    const world::Trajectory& trajectory) {
  const auto here = project(trajectory, ego.x_m, ego.y_m);
  if (!here) return kUnset;
  return at(trajectory, *here + std::max(ego.vx_mps, 0.0) * p.speed_preview_s).speed_mps;
}

LateralDiagnostics steer(const Params& p, const LateralGains& gains, const Inputs& in,
                         double last_angle_rad, steering::State& steering, Duration dt) {
  const Angles angles{last_angle_rad, in.angle_max_rad};
  if (p.drive_law == LateralLaw::kFeedForward)
    return steer_forward(p.steering, p.lateral, in.learned, steering, angles, in.ego, in.trajectory,
                         dt);
  steering.begun = false;
  return steer(p.lateral, gains, angles, in.ego, in.trajectory);
}

LongitudinalOutput drive(const Params& p, const State& state, const Inputs& in, bool following,
                         Duration dt) {
  const double target = following ? target_speed(p.longitudinal, in.ego, in.trajectory) : kUnset;
  return step(p.longitudinal, state.longitudinal, target, in.ego.vx_mps, dt);
}

}  // namespace

Result<LateralGains, Problem> prepare(const Params& params) {
  if (auto problem = illegal(params)) return Unexpected{*problem};
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
