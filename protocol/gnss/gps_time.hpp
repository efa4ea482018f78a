// GPS time: as week and time of week, the form that receivers send, and as one integer to compute
// with. It has no leap seconds.
//   units  nanoseconds since 1980-01-06T00:00:00 (GPS)
//   source IS-GPS-200
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>

#include "protocol/vocabulary/time.hpp"

namespace pitwall::gnss {

inline constexpr std::int64_t kWeek_ms = 7LL * 24 * 3'600 * 1'000;

// Point on the GPS time scale. Not convertible to Instant: the offset between them is estimated.
struct GpsTime {
  std::int64_t ns = 0;

  constexpr auto operator<=>(const GpsTime&) const = default;
};

// In the year 2209; six more decades fit into 64 bits, as room for additions. A later week is an
// error of the receiver.
inline constexpr std::uint16_t kMaxWeek = 12'000;

constexpr bool is_week(std::uint16_t week) { return week != 0 && week <= kMaxWeek; }

// A week after kMaxWeek is limited to kMaxWeek.
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
