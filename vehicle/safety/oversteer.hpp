// Oversteer detection from two indicators, each over two consecutive ticks: both rear wheels are
// faster (or, braking, slower) than the front wheels and the speed of localization; or the car yaws
// faster than its front wheels are steered, or against them.
//   in     wheel speeds, measured angle of the road wheels, speed and yaw rate of localization
//   out    the larger indicator relative to its limit (above 1); 0 if there is no oversteer
//   invariants
//          one wheel that has a wrong sensor, spins, locks or leaves the ground over a bump has no
//          effect, nor has a launch: below speed_min nothing is detected
//   model  the steady-state bicycle of steering/learned_steering.hpp, on a level road
//   errors unknown inputs give no detection
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <type_traits>

#include "protocol/vocabulary/units.hpp"
#include "vehicle/steering/learned_steering.hpp"
#include "vehicle/world/legal_range.hpp"
#include "vehicle/world/signals.hpp"

namespace pitwall::safety {

struct OversteerParams {
  double speed_min_mps = 12.0;
  double rear_spin_max = 0.10;  // of the speed
  double rear_lock_max = 0.20;  // of the speed
  double yaw_excess_max_rad_per_s = 0.25;
  steering::Bicycle bicycle;
};

inline constexpr auto kOversteerRanges = std::to_array<world::NamedRange<OversteerParams>>({
    {"speed_min_mps", &OversteerParams::speed_min_mps, 5.0, 30.0},
    {"rear_spin_max", &OversteerParams::rear_spin_max, 0.03, 0.5},
    {"rear_lock_max", &OversteerParams::rear_lock_max, 0.05, 0.9},
    {"yaw_excess_max_rad_per_s", &OversteerParams::yaw_excess_max_rad_per_s, 0.1, 1.0},
});

struct OversteerInputs {
  world::PerWheel wheel_mps;
  double road_wheel_rad = kUnset;
  double speed_mps = kUnset, yaw_rate_rad_per_s = kUnset;  // from localization
};

struct OversteerState {
  std::uint8_t ticks = 0;  // consecutive ticks above the limit
};
static_assert(std::is_trivially_copyable_v<OversteerState>);

inline constexpr std::uint8_t kOversteerTicks = 2;

double oversteer(const OversteerParams& params, OversteerState& state,
                 const OversteerInputs& inputs);

// Indicators of one tick, each 1 at its limit.
double rear_slip(const OversteerParams& params, const OversteerInputs& inputs);
double yaw_excess(const OversteerParams& params, const OversteerInputs& inputs);

}  // namespace pitwall::safety
