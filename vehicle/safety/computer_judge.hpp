// Health monitor of the car's computer: late ticks, processor load, memory and temperature.
//   in     the time, once per tick; world::ComputerHealth
//   out    ComputerVerdict; `gap` is the time since the previous tick
//   invariants
//          a late tick adds its gap to a sum of lost time, which decays by `idle_share` of the
//          elapsed time. Above `late_max` the verdict is `late`, which stops the car. So one short
//          pause is only reported; a long one, or many, stop the car
//          a value that is not available is not checked
//   units  seconds, shares, MiB, degrees Celsius
//   errors none
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <type_traits>

#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/world/health.hpp"
#include "vehicle/world/legal_range.hpp"

namespace pitwall::safety {

struct ComputerParams {
  double idle_share = 0.5;       // share of time that may be lost
  double late_max_s = 0.5;       // limit of the sum of lost time
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
  Instant at{};         // last tick
  double late_s = 0.0;  // sum of lost time
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
