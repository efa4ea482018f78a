// Plausibility check of decoded values: the ranges of the parameters, and the slew limits of the
// database's side file for the time since the last accepted value.
//   in     values in any unit for ranges, in units of the database for slews
//   out    Reading; settle() stores all values of a frame or none
//   errors by value
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>

#include "protocol/can/av21.hpp"
#include "vehicle/gateway/inbound.hpp"
#include "vehicle/gateway/readings.hpp"

namespace pitwall::gateway {

// Tolerance for the rounding of physical values.
inline constexpr double kRounding = 1e-9;

struct Context {
  const InboundParams& params;
  InboundState& state;
  Instant at;
};

// A value and its range.
struct Ranged {
  double value;
  Span span;
};

template <std::size_t N>
Reading in_range(const std::array<Ranged, N>& values) {
  for (const Ranged& r : values) {
    if (!std::isfinite(r.value)) return Reading::kNotFinite;
    if (r.value < r.span.min || r.value > r.span.max) return Reading::kOutOfRange;
  }
  return Reading::kApplied;
}

// Row of a signal without a limit.
inline constexpr std::size_t kNoLimit = can::av21::kSlews.size();

consteval std::size_t slew_row(std::uint32_t id, std::string_view signal) {
  for (std::size_t i = 0; i < can::av21::kSlews.size(); ++i)
    if (can::av21::kSlews[i].id == id && can::av21::kSlews[i].signal == signal) return i;
  return kNoLimit;
}

// Message period of each row of kSlews.
inline constexpr auto kSlewPeriods = [] {
  std::array<Duration, kNoLimit> periods{};
  for (std::size_t i = 0; i < kNoLimit; ++i)
    for (const can::MessageRow& row : can::av21::kMessages)
      if (row.id == can::av21::kSlews[i].id) periods[i] = row.period;
  return periods;
}();

// A new value of a row of kSlews, in units of the database.
struct Change {
  std::size_t row;
  double value;
};

inline bool too_fast(const Context& c, const Change& change) {
  if (change.row == kNoLimit) return false;
  const SlewTrack& track = c.state.slews[change.row];
  if (std::isnan(track.value)) return false;
  const can::SlewRow& limit = can::av21::kSlews[change.row];
  const Duration passed = std::max(c.at - track.at, kSlewPeriods[change.row]);
  return std::abs(change.value - track.value) > limit.max_per_s * passed.seconds() + kRounding;
}

// Stores all values, or none if one changes too fast.
template <std::size_t N>
Reading settle(Context& c, const std::array<Change, N>& changes) {
  for (const Change& change : changes)
    if (too_fast(c, change)) return Reading::kImplausibleSlew;
  for (const Change& change : changes)
    if (change.row != kNoLimit) c.state.slews[change.row] = {change.value, c.at};
  return Reading::kApplied;
}

template <std::size_t R, std::size_t N>
Reading accept(Context& c, const std::array<Ranged, R>& ranged,
               const std::array<Change, N>& changes) {
  if (c.params.off.has(world::Monitor::kDecodedRange)) return Reading::kApplied;
  const Reading range = in_range(ranged);
  return range == Reading::kApplied ? settle(c, changes) : range;
}
template <std::size_t R>
Reading accept(Context& c, const std::array<Ranged, R>& ranged) {
  if (c.params.off.has(world::Monitor::kDecodedRange)) return Reading::kApplied;
  return in_range(ranged);
}

}  // namespace pitwall::gateway
