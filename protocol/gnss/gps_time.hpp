// GPS time: week and time of week, as receivers say it, and as one integer to compute with. Leap
// seconds do not occur in it.
//   units  nanoseconds since 1980-01-06T00:00:00 (GPS)
//   source IS-GPS-200
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>

#include "protocol/vocabulary/time.hpp"

namespace pitwall::gnss {

inline constexpr std::int64_t kWeek_ms = 7LL * 24 * 3'600 * 1'000;

// A point on the GPS time scale. Never mixed with Instant: the offset between the two is estimated.
struct GpsTime {
  std::int64_t ns = 0;

  constexpr auto operator<=>(const GpsTime&) const = default;
};

// The year 2209; six decades more fit into 64 bits, for what is added to it. A receiver that says a
// later week is wrong.
inline constexpr std::uint16_t kMaxWeek = 12'000;

constexpr bool is_week(std::uint16_t week) { return week != 0 && week <= kMaxWeek; }

// A week behind kMaxWeek is taken as that one.
constexpr GpsTime gps_time(std::uint16_t week, Duration of_week) {
  return {static_cast<std::int64_t>(std::min(week, kMaxWeek)) * kWeek_ms * 1'000'000 + of_week.ns};
}

constexpr std::uint16_t week(GpsTime t) {
  return static_cast<std::uint16_t>(t.ns / (kWeek_ms * 1'000'000));
}
constexpr Duration of_week(GpsTime t) { return {t.ns % (kWeek_ms * 1'000'000)}; }

constexpr Duration operator-(GpsTime a, GpsTime b) { return {a.ns - b.ns}; }
constexpr GpsTime operator+(GpsTime t, Duration d) { return {t.ns + d.ns}; }

}  // namespace pitwall::gnss
