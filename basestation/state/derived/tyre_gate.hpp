// Tyre temperature required for a speed: a table, not one number, because a cold oval may never
// warm the tyres to the temperature of the highest speed.
//   in     speed [m/s]
//   out    the lowest temperature of the coldest tyre [degC] for it
//   invariants
//          linear between the rows; no requirement below the first row; beyond the last row its
//          temperature
//   source Saba et al.: spin above 62.6 m/s (140 mph) at 29 degC, where 79 degC were needed; the
//          rows between are our own, at the passing competition's speeds of 80 to 125 mph
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "protocol/vocabulary/units.hpp"

namespace pitwall::state {

inline constexpr double kNoTyreGate_c = -40.0;

struct TyreGate {
  static constexpr std::size_t kRows = 5;
  std::array<double, kRows> speed_mps{from_mph(80), from_mph(100), from_mph(115), from_mph(125),
                                      from_mph(140)};
  std::array<double, kRows> temperature_c{25.0, 40.0, 50.0, 60.0, 79.0};
};
double tyre_needed_c(const TyreGate& gate, double speed_mps);

}  // namespace pitwall::state
