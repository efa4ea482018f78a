// Gear selection by speed with hysteresis: shifts up at one speed and down at a lower one, one gear
// at a time, with a minimum time between shifts.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/world/legal_range.hpp"

namespace pitwall::control {

inline constexpr std::size_t kGears = 6;

struct GearParams {
  // Index i is the shift between gears i+1 and i+2. Values rise, and down_below < up_above
  // (hysteresis).
  std::array<double, kGears - 1> up_above_mps{kUnset, kUnset, kUnset, kUnset, kUnset};
  std::array<double, kGears - 1> down_below_mps{kUnset, kUnset, kUnset, kUnset, kUnset};
  double dwell_s = kUnset;  // minimum time between shifts
};

inline constexpr auto kGearRanges = std::to_array<world::NamedRange<GearParams>>({
    {"dwell_s", &GearParams::dwell_s, 0.2, 5.0},
});

struct GearState {
  std::uint8_t gear = 1;  // 1..kGears
  Instant changed{};      // time of the last shift
  bool ever_changed = false;
};

// The gear is held if the speed is not finite.
GearState step(const GearParams& params, const GearState& state, double speed_mps, Instant now);

}  // namespace pitwall::control
