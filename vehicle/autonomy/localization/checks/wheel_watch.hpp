// Speed of the car from the wheels, without wheels that lock, spin, are missing or have a wrong
// sensor.
//   in     four wheel speeds over ground, the yaw rate, the speed from the receivers if available
//   out    speed of the centre of gravity, NaN if every wheel is excluded; whether a wheel is
//          excluded
//   invariants
//          each wheel speed is corrected by the yaw rate to the centre line of the car. A wheel
//          that differs from the receivers' speed, or without it from the median of the four, is
//          excluded at once, and used again after readmit_after_s of agreement. The rear axle gives
//          the speed, as the filter expects; the front axle if both rear wheels are excluded
//   units  m/s, rad/s; positive yaw rate turns left
//   cost   O(1)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <type_traits>

#include "protocol/vocabulary/time.hpp"
#include "vehicle/autonomy/localization/checks/check_params.hpp"
#include "vehicle/world/signals.hpp"

namespace pitwall::localization {

struct WheelWatch {
  struct Wheel {
    bool out = false, agrees = false;
    Instant agrees_since{};
  };
  std::array<Wheel, world::kCorners> wheels{};
};
static_assert(std::is_trivially_copyable_v<WheelWatch>);

struct WheelFacts {
  world::PerWheel speed_mps;
  double yaw_rate_rad_per_s = 0.0;
  double by_receivers_mps = kUnset;  // unset: not available
};

struct WheelSpeed {
  double speed_mps = kUnset;
  bool contradiction = false;  // at least one wheel is excluded
};

// `watched` false: the mean of all four wheels, NaN if one of them is not a number.
WheelSpeed watch_wheels(const CheckParams& params, WheelWatch& watch, const WheelFacts& facts,
                        bool watched, Instant now);

}  // namespace pitwall::localization
