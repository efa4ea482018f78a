// Is the car's own computer up to it? Ticks that did not come when they were due, and what the rim
// knows of processor, memory and temperature.
//   in     now, once per tick; world::ComputerHealth
//   out    what is wrong; `gap` is the time since the tick before
//   invariants
//          one sleep is told and forgiven; a computer that does not run for more than `idle_share`
//          of the time for long uses up a budget of `late_max` and stops the car. What the rim does
//          not know is not judged
//   units  seconds, shares, MiB, degrees Celsius
//   errors none
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <type_traits>

#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/world/computer_health.hpp"

namespace pitwall::safety {

struct ComputerParams {
  double idle_share = 0.5;        // time lost that is forgiven; [0.1, 0.9]
  double late_max_s = 0.5;        // beyond it, summed up; [0.2, 5]
  double processor_warn = 0.97;   // share; [0.5, 1]
  double memory_max_mib = 30e3;   // [256, 1e6]
  double temperature_max_c = 95;  // [60, 120]
};

struct ComputerState {
  Instant at{};         // of the last tick
  double late_s = 0.0;  // lost and not forgiven yet
};
static_assert(std::is_trivially_copyable_v<ComputerState>);

struct ComputerVerdict {
  bool missed = false, late = false, busy = false, full = false, hot = false;
  Duration gap{};
};

inline constexpr Duration kTickLate = milliseconds(25);  // two ticks missed

ComputerVerdict judge_computer(const ComputerParams& params, ComputerState& state,
                               const world::ComputerHealth& health, Instant now);

}  // namespace pitwall::safety
