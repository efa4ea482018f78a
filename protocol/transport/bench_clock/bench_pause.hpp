// Pauses of the bench clock: length of the present pause, and sum of all pauses.
//
//   wall clock   0    10    20    30    40
//   bench time   0    10    10    10    20
//   now          0     0    10    20     0
//   total        0     0    10    20    20
//
//   in     the clock page that the bench writes; the wall clock
//   out    durations by the wall clock
//   invariants
//          total is the lag of bench time behind the wall clock. It decreases if bench time leaps
//          forward to the time of a guest
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "protocol/transport/bench_clock/clock_page.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::transport {

struct BenchPause {
  // Pauses of this length are reported to operators: sooner than a console reports a silent base.
  static constexpr Duration kLong = milliseconds(150);

  Duration now{};    // zero: bench time runs
  Duration total{};  // including the present pause

  constexpr bool is_long() const { return now >= kLong; }
  constexpr bool operator==(const BenchPause&) const = default;
};

// bench_now() and the pause of the same moment.
struct ClockReading {
  Instant now{};
  BenchPause pause{};
};

// Reads in the order of bench_now(), so that a pause that ends meanwhile does not appear longer.
template <class ReadWall>
ClockReading read_clock(const ClockPage& page, ReadWall&& wall) {
  const std::int64_t horizon_ns = page.horizon_ns.load(std::memory_order_acquire);
  const std::int64_t lost_ns = page.lost_ns.load(std::memory_order_acquire);
  const Instant at = wall();
  const std::int64_t past_ns = std::max<std::int64_t>(at.ns - lost_ns - horizon_ns, 0);
  const BenchPause pause{.now = {past_ns}, .total = {lost_ns + past_ns}};
  return {.now = at - pause.total, .pause = pause};
}

template <class ReadWall>
BenchPause pause_of(const ClockPage& page, ReadWall&& wall) {
  return read_clock(page, wall).pause;
}

}  // namespace pitwall::transport
