// The speed of the car by its wheels, without the ones that lock, spin, are lost or lie.
//   in     four wheel speeds over ground, the yaw rate, the car's speed where the receivers say it
//   out    speed of the centre of gravity, NaN if no wheel is believed; which wheels are not
//   invariants
//          each wheel is brought to the middle of the car by the yaw rate; one that is far from
//          the middle of the four, or that the receivers contradict, is out at once and comes back
//          after readmit_after_s of agreement. The rear axle speaks for the car, as the filter
//          expects; the front one where no rear wheel is believed
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
  double by_receivers_mps = kUnset;  // unset: they have not said lately
};

struct WheelSpeed {
  double speed_mps = kUnset;
  bool contradiction = false;  // some wheel is out
};

// `watched` false: every wheel is believed, and a mean with one that is not a number is not one.
WheelSpeed watch_wheels(const CheckParams& params, WheelWatch& watch, const WheelFacts& facts,
                        bool watched, Instant now);

}  // namespace pitwall::localization
