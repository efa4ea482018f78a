// Time types: a span (Duration), a point on the monotonic clock (Instant) and a point on the
// calendar (UtcTime, for labels only). Instant and UtcTime do not mix. Only
// protocol/transport/clock reads the time; all other code gets it as an argument.
//   units  int64 nanoseconds, range +-292 years
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <cstdint>

namespace pitwall {

inline constexpr std::int64_t kNanosecondsPerSecond = 1'000'000'000;
inline constexpr std::int64_t kNanosecondsPerMillisecond = 1'000'000;

struct Duration {
  std::int64_t ns = 0;

  constexpr double seconds() const { return static_cast<double>(ns) * 1e-9; }
  constexpr double milliseconds() const { return static_cast<double>(ns) * 1e-6; }
  constexpr auto operator<=>(const Duration&) const = default;
};

constexpr Duration operator+(Duration a, Duration b) { return {a.ns + b.ns}; }
constexpr Duration operator-(Duration a, Duration b) { return {a.ns - b.ns}; }
constexpr Duration operator-(Duration a) { return {-a.ns}; }
constexpr Duration operator*(Duration a, std::int64_t k) { return {a.ns * k}; }
constexpr Duration operator*(std::int64_t k, Duration a) { return {a.ns * k}; }
constexpr Duration operator/(Duration a, std::int64_t k) { return {a.ns / k}; }
constexpr std::int64_t operator/(Duration a, Duration b) { return a.ns / b.ns; }

constexpr Duration nanoseconds(std::int64_t n) { return {n}; }
constexpr Duration microseconds(std::int64_t n) { return {n * 1'000}; }
constexpr Duration milliseconds(std::int64_t n) { return {n * 1'000'000}; }
constexpr Duration seconds(std::int64_t n) { return {n * kNanosecondsPerSecond}; }
// Nearest nanosecond; for parameters, which are read as fractions of a second.
constexpr Duration from_seconds(double s) {
  return {static_cast<std::int64_t>(s * 1e9 + (s < 0.0 ? -0.5 : 0.5))};
}

// Point on the monotonic clock: time since its start (boot on a car, scenario start in lockstep).
struct Instant {
  std::int64_t ns = 0;

  // Time of an event that never comes: the deadline of a wait without end.
  static constexpr Instant max() { return {INT64_MAX}; }
  constexpr double seconds() const { return static_cast<double>(ns) * 1e-9; }
  constexpr double milliseconds() const { return static_cast<double>(ns) * 1e-6; }
  constexpr auto operator<=>(const Instant&) const = default;
};

constexpr Duration operator-(Instant a, Instant b) { return {a.ns - b.ns}; }
constexpr Instant operator+(Instant a, Duration d) { return {a.ns + d.ns}; }
constexpr Instant operator-(Instant a, Duration d) { return {a.ns - d.ns}; }
constexpr Instant& operator+=(Instant& a, Duration d) {
  a.ns += d.ns;
  return a;
}

// Calendar time since 1970-01-01T00:00:00Z, without leap seconds. It labels recordings and is not
// used for decisions.
struct UtcTime {
  std::int64_t ns = 0;

  constexpr double milliseconds() const { return static_cast<double>(ns) * 1e-6; }
  constexpr auto operator<=>(const UtcTime&) const = default;
};

}  // namespace pitwall
