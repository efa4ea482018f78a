// Detection of over-steer and of front wheels that lock.
//   rear spin   both rear wheels are faster than the front wheels and the car
//   rear lock   both rear wheels are slower than the front wheels and the car
//   yaw excess  the car yaws faster than its front wheels are steered, or against them
//   front lock  a front wheel is slower than the car and the other wheels
//   in     the two newest wheel-speed frames, measured angle of the road wheels, pressure of the
//          front brake, speed and yaw rate of localization
//   out    each indicator of over-steer relative to its limit (above 1), or 0; slip of the front
//          wheels
//   invariants
//          the wheels must show it in two consecutive frames, whatever the tick; the yaw rate,
//          which is new in every tick, in two consecutive ticks
//          one wheel that has a wrong sensor, spins, locks or leaves the ground over a bump is no
//          over-steer, nor is a launch: below speed_min none is detected
//          a single front wheel locks only if its sensor agreed with the others when the brake was
//          last released: a sensor that was wrong before has no effect
//   model  the steady-state bicycle of steering/learned_steering.hpp, on a level road
//   errors unknown inputs give no detection
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "protocol/vocabulary/time.hpp"
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

// The newest frame and the one before.
using WheelFrames = std::array<world::PerWheel, 2>;
inline constexpr Duration kSlipAgeMax = milliseconds(50);
// Unset if the older of the two is older than kSlipAgeMax.
WheelFrames wheel_frames(const world::VehicleSignals& signals, Instant now);

struct OversteerInputs {
  WheelFrames wheel_mps{};
  double road_wheel_rad = kUnset;
  double speed_mps = kUnset, yaw_rate_rad_per_s = kUnset;  // from localization
};

struct OversteerState {
  std::uint8_t yaw_ticks = 0;  // consecutive ticks above the limit
};
static_assert(std::is_trivially_copyable_v<OversteerState>);

inline constexpr std::uint8_t kOversteerTicks = 2;

// Each 0, or above 1.
struct Oversteer {
  double rear_spin = 0.0, rear_lock = 0.0, yaw_excess = 0.0;

  constexpr bool any() const { return rear_spin > 0.0 || rear_lock > 0.0 || yaw_excess > 0.0; }
};

Oversteer detect_oversteer(const OversteerParams& params, OversteerState& state,
                           const OversteerInputs& inputs);

struct FrontWheelInputs {
  WheelFrames wheel_mps{};
  double speed_mps = kUnset;  // from localization; unset: the wheels alone
  double brake_kpa = kUnset;  // front, measured
  double lock_slip = kUnset;  // a wheel that slips more is locking
};

struct FrontWheelState {
  std::array<bool, 2> agreed{};  // left, right: when the brake was last released
};
static_assert(std::is_trivially_copyable_v<FrontWheelState>);

// Slip of the front wheel that slips most, relative to the second fastest wheel and the car. NaN if
// a wheel speed is unknown; zero for a car that hardly moves, and for a wheel that is not believed.
double front_slip(FrontWheelState& state, const FrontWheelInputs& inputs);

// The inputs of one tick.
FrontWheelInputs front_wheels_of(const world::VehicleSignals& signals, double lock_slip,
                                 double speed_mps, Instant now);

}  // namespace pitwall::safety
