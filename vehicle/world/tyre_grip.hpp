// Grip of a tyre by its temperature, as a share of the friction of a warm tyre.
//   in     mean temperature of every tyre from the CAN bus; a value that is missing, not a number
//          or older than kTyreAgeMax is unknown
//   out    share of the warm friction, (0, 1], linear between the rows of the table
//   invariants
//          the coldest tyre counts, and an unknown temperature counts as cold: the first row. Above
//          the last row the share is that of the last row: overheating is not modelled
//   source 29 C against at least 79 C: Saba et al., Fast and Modular Autonomy Software (a spin on
//          cold tyres); the shares between are estimates
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/world/signals.hpp"

namespace pitwall::world {

inline constexpr std::size_t kTyreRows = 4;
inline constexpr Duration kTyreAgeMax = seconds(30);  // a tyre takes minutes to cool

struct TyreGrip {
  std::array<double, kTyreRows> temperature_c{30.0, 50.0, 65.0, 79.0};  // rising
  std::array<double, kTyreRows> share{0.60, 0.74, 0.86, 1.0};           // (0, 1], never falling

  constexpr double cold() const { return share.front(); }
};

inline double coldest_c(const Received<PerWheel>& tyres, Instant now) {
  if (!tyres.fresh(now, kTyreAgeMax)) return kUnset;
  double coldest = tyres.value.at[0];
  for (const double tyre_c : tyres.value.at) {
    if (!std::isfinite(tyre_c)) return kUnset;
    coldest = std::min(coldest, tyre_c);
  }
  return coldest;
}

// Place of a temperature between two rows of the table.
struct TyrePlace {
  std::size_t row = 0;
  double to_next = 0.0;  // 0 at the row, 1 at the next
};
inline constexpr TyrePlace kWarmTyres{kTyreRows - 2, 1.0};

inline TyrePlace place_of(const TyreGrip& grip, double tyre_c) {
  if (!(tyre_c > grip.temperature_c.front())) return {};
  for (std::size_t i = 1; i < kTyreRows; ++i) {
    const double from_c = grip.temperature_c[i - 1], to_c = grip.temperature_c[i];
    if (tyre_c < to_c) return {i - 1, (tyre_c - from_c) / (to_c - from_c)};
  }
  return kWarmTyres;
}

// Of a value of each row.
inline double between(const std::array<double, kTyreRows>& rows, const TyrePlace& at) {
  const double from = rows[at.row], to = rows[at.row + 1];
  return at.to_next < 1.0 ? from + at.to_next * (to - from) : to;
}

inline double share_at(const TyreGrip& grip, double tyre_c) {
  return between(grip.share, place_of(grip, tyre_c));
}

inline bool is_legal(const TyreGrip& grip) {
  for (std::size_t i = 0; i < kTyreRows; ++i) {
    if (!std::isfinite(grip.temperature_c[i])) return false;
    if (!(grip.share[i] > 0.0 && grip.share[i] <= 1.0)) return false;
    if (i > 0 && !(grip.temperature_c[i] > grip.temperature_c[i - 1])) return false;
    if (i > 0 && !(grip.share[i] >= grip.share[i - 1])) return false;
  }
  return true;
}

}  // namespace pitwall::world
