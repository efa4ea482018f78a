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

#include <array>
#include <type_traits>

#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/world/computer_health.hpp"
#include "vehicle/world/legal_range.hpp"

namespace pitwall::safety {

struct ComputerParams {
  double idle_share = 0.5;       // time lost that is forgiven
  double late_max_s = 0.5;       // beyond it, summed up
  double processor_warn = 0.97;  // share
  double memory_max_mib = 30e3;
  double temperature_max_c = 95;
};

inline constexpr auto kComputerRanges = std::to_array<world::NamedRange<ComputerParams>>({
    {"idle_share", &ComputerParams::idle_share, 0.1, 0.9},
    {"late_max_s", &ComputerParams::late_max_s, 0.2, 5.0},
    {"processor_warn", &ComputerParams::processor_warn, 0.5, 1.0},
    {"memory_max_mib", &ComputerParams::memory_max_mib, 256.0, 1e6},
    {"temperature_max_c", &ComputerParams::temperature_max_c, 60.0, 120.0},
});

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
