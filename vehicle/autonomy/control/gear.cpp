// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/control/gear.hpp"

#include <algorithm>

namespace pitwall::control {
namespace {

constexpr Duration kReportAgeMax = milliseconds(100);  // ten of its periods
constexpr std::uint8_t kShiftsUp = 3, kShiftsDown = 4;

std::uint8_t engaged(const GearReport& report) {
  return static_cast<std::uint8_t>(std::min<std::size_t>(report.gear, kGears));
}

// The gear of the next shift, or the present one. A target that is not a number decides nothing.
std::uint8_t gear_for(const GearParams& p, std::uint8_t gear, const GearInputs& in) {
  const std::size_t index = gear - std::size_t{1};  // of the shift upwards from here
  if (index < kGears - 1) {
    const double up_mps = p.up_above_mps[index];
    const bool below = in.target_mps <= up_mps && !(in.speed_mps > up_mps + kBeyond_mps);
    if (in.speed_mps > up_mps && !below) return static_cast<std::uint8_t>(gear + 1);
  }
  if (index >= 1 && index < kGears) {
    const double down_mps = p.down_below_mps[index - 1];
    const bool above = in.target_mps >= down_mps && !(in.speed_mps < down_mps - kBeyond_mps);
    if (in.speed_mps < down_mps && !above) return static_cast<std::uint8_t>(gear - 1);
  }
  return gear;
}

// The gearbox has another gear than it was asked for.
GearState wait(const GearParams& p, const GearState& state, const GearReport& report, Instant now) {
  GearState next = state;
  if (!state.waiting) {
    next.waiting = true;
    next.asked = now;
  } else if (!(now - state.asked < from_seconds(p.confirm_s))) {
    ++next.missed;
    next.asked = next.changed = now;
    next.ever_changed = true;
    if (report.gear >= 1) next.gear = engaged(report);
  }
  return next;
}

}  // namespace

GearReport gear_report(const world::Received<world::Powertrain>& powertrain, Instant now) {
  const std::uint8_t status = powertrain.value.gear_shift_status;
  return {.known = powertrain.fresh(now, kReportAgeMax),
          .gear = powertrain.value.gear,
          .shifting = status == kShiftsUp || status == kShiftsDown};
}

GearState step(const GearParams& params, const GearState& state, const GearInputs& in,
               Instant now) {
  GearState next = state;
  if (in.report.known && in.drives && in.report.gear != state.gear)
    return wait(params, state, in.report, now);
  next.waiting = false;
  if (in.report.known && !in.drives && in.report.gear >= 1)
    return next.gear = engaged(in.report), next;
  if (state.ever_changed && now - state.changed < from_seconds(params.dwell_s)) return next;
  const std::uint8_t gear = gear_for(params, state.gear, in);
  if (gear == state.gear) return next;
  next.gear = gear;
  next.changed = next.asked = now;
  next.ever_changed = next.waiting = true;
  return next;
}

}  // namespace pitwall::control
