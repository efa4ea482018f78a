// Does the rear of the car step out? Two signs, each over two ticks in a row: both rear wheels turn
// faster (or, braked, slower) than the road passes by, as the front wheels and localization have
// it; or the car turns faster than its front wheels are steered, or the other way.
//   in     wheel speeds, angle of the road wheels as measured, speed and yaw rate of localization
//   out    by how much the worse sign exceeds its limit, 1 at the limit; 0: no over-steer
//   invariants
//          one wheel that lies, spins, locks or has left the ground over a bump has no say, nor has
//          a launch: below speed_min nothing is judged
//   model  the steady-state bicycle of steering/learned_steering.hpp, on a level road
//   errors what is not known is not judged
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
  double speed_mps = kUnset, yaw_rate_rad_per_s = kUnset;  // by localization
};

struct OversteerState {
  std::uint8_t ticks = 0;  // in a row
};
static_assert(std::is_trivially_copyable_v<OversteerState>);

inline constexpr std::uint8_t kOversteerTicks = 2;

double oversteer(const OversteerParams& params, OversteerState& state,
                 const OversteerInputs& inputs);

// The signs of one tick, each 1 at its limit.
double rear_slip(const OversteerParams& params, const OversteerInputs& inputs);
double yaw_excess(const OversteerParams& params, const OversteerInputs& inputs);

}  // namespace pitwall::safety
