// Gear choice from a table over speed: up at one speed, down at a lower one, a minimum dwell
// between shifts and never two gears at once.
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
  // Index i is the shift between gear i+1 and i+2; rising, down_below < up_above (hysteresis).
  std::array<double, kGears - 1> up_above_mps{kUnset, kUnset, kUnset, kUnset, kUnset};
  std::array<double, kGears - 1> down_below_mps{kUnset, kUnset, kUnset, kUnset, kUnset};
  double dwell_s = kUnset;  // least time between shifts
};

inline constexpr auto kGearRanges = std::to_array<world::NamedRange<GearParams>>({
    {"dwell_s", &GearParams::dwell_s, 0.2, 5.0},
});

struct GearState {
  std::uint8_t gear = 1;  // 1..kGears
  Instant changed{};      // at the last shift
  bool ever_changed = false;
};

// A speed that is not finite holds the gear.
GearState step(const GearParams& params, const GearState& state, double speed_mps, Instant now);

}  // namespace pitwall::control
