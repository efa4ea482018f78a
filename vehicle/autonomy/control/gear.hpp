// Gear selection by speed with hysteresis: shifts up at one speed and down at a lower one, one gear
// at a time, with a minimum time between shifts, and checked against the gearbox.
//   in     speed and target speed, the gear that the drive-by-wire reports
//   out    the gear to ask for, 1..kGears; how many shifts the gearbox missed
//   invariants
//          who holds a target below a shift does not shift up for a little overshoot, and likewise
//          down: target and speed agree, or the speed is kBeyond_mps past the shift
//          the next shift waits until the gearbox reports the last one. What it does not report
//          within confirm_s is missed: the gear that it has is asked for, for dwell_s at least
//          without a fresh report the speed alone decides; who does not drive the car asks for what
//          it has
//   errors the gear is held if the speed is not finite
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/world/legal_range.hpp"
#include "vehicle/world/signals.hpp"

namespace pitwall::control {

inline constexpr std::size_t kGears = 6;

struct GearParams {
  // Index i is the shift between gears i+1 and i+2. Values rise, and down_below < up_above
  // (hysteresis).
  std::array<double, kGears - 1> up_above_mps{kUnset, kUnset, kUnset, kUnset, kUnset};
  std::array<double, kGears - 1> down_below_mps{kUnset, kUnset, kUnset, kUnset, kUnset};
  double dwell_s = kUnset;    // minimum time between shifts
  double confirm_s = kUnset;  // for the gearbox to report a shift
};

inline constexpr auto kGearRanges = std::to_array<world::NamedRange<GearParams>>({
    {"dwell_s", &GearParams::dwell_s, 0.2, 5.0},
    {"confirm_s", &GearParams::confirm_s, 0.2, 5.0},
});

inline constexpr double kBeyond_mps = 1.0;

// What the gearbox says.
struct GearReport {
  bool known = false;
  std::uint8_t gear = 0;  // 0 neutral
  bool shifting = false;
};
GearReport gear_report(const world::Received<world::Powertrain>& powertrain, Instant now);

struct GearInputs {
  double speed_mps = kUnset;
  double target_mps = kUnset;  // unset: the speed alone
  GearReport report{};
  bool drives = true;  // the gear that is asked for is sent to the car
};

struct GearState {
  std::uint8_t gear = 1;  // 1..kGears
  Instant changed{};      // time of the last shift
  bool ever_changed = false;
  bool waiting = false;  // for the gearbox, since `asked`
  Instant asked{};
  std::uint32_t missed = 0;  // shifts since the start
};

GearState step(const GearParams& params, const GearState& state, const GearInputs& inputs,
               Instant now);

}  // namespace pitwall::control
