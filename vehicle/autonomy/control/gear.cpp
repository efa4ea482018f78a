// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/control/gear.hpp"

namespace pitwall::control {

GearState step(const GearParams& params, const GearState& state, double speed_mps, Instant now) {
  if (state.ever_changed && now - state.changed < from_seconds(params.dwell_s)) return state;
  const std::size_t index = state.gear - std::size_t{1};  // of the shift upwards from here
  const auto shifted = [&](std::uint8_t gear) { return GearState{gear, now, true}; };
  if (index < kGears - 1 && speed_mps > params.up_above_mps[index]) {
    return shifted(static_cast<std::uint8_t>(state.gear + 1));
  }
  if (index >= 1 && index < kGears && speed_mps < params.down_below_mps[index - 1]) {
    return shifted(static_cast<std::uint8_t>(state.gear - 1));
  }
  return state;
}

}  // namespace pitwall::control
