// Clock page: shared memory by which the processes of one machine share bench time.
//
//   bench time = wall clock (CLOCK_MONOTONIC) minus lost time, and never beyond the horizon
//
//   in     the bench alone writes lost time and horizon; each thread that takes turns, its own slot
//   out    bench_now(), the same for every reader to within the cost of a clock reading
//   invariants
//          it never goes back for a reader, never runs faster than the wall clock except in a
//          ClockKeeper::leap(), and stands at the horizon. Before the first bench it is the wall
//          clock
//   units  int64 nanoseconds
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "protocol/vocabulary/time.hpp"

namespace pitwall::transport {

// Thread of a program for whose turn the bench waits.
struct ClockSlot {
  std::atomic<std::int32_t> process{0};  // 0: free
  std::atomic<std::int32_t> thread{0};
  static constexpr std::int64_t kAtWork = INT64_MIN;
  std::atomic<std::int64_t> due_ns{0};  // bench time at which its turn begins
  std::atomic<std::uint64_t> turns{0};  // even: waits for the next turn; odd: works
  // Futex: 1 while the thread sleeps until the horizon comes to due_ns, and the bench wakes it.
  std::atomic<std::uint32_t> asleep{0};
};

// Interval of the wall clock in which bench time stood.
struct ClockPause {
  std::atomic<std::int64_t> from_ns{0}, to_ns{0};
};

struct ClockPage {
  static constexpr std::uint64_t kMagic = 0x3230'4B43'4F4C'4350;  // "PCLOCK02"
  static constexpr std::size_t kSlots = 16;
  static constexpr std::size_t kPauses = 32;  // stored pauses, to convert stamps of the kernel

  std::atomic<std::uint64_t> magic{0};
  std::atomic<std::int64_t> lost_ns{0};
  std::atomic<std::int64_t> horizon_ns{INT64_MAX};
  std::atomic<std::uint64_t> pauses_made{0};
  std::array<ClockPause, kPauses> pauses;
  std::array<ClockSlot, kSlots> slots;
};
static_assert(std::atomic<std::int64_t>::is_always_lock_free);
static_assert(std::is_standard_layout_v<ClockPage>);

// Present bench time. The horizon is read first and the wall clock last, so that no reader sees
// time go back: the bench raises the lost time before it moves the horizon.
template <class ReadWall>
Instant bench_now(const ClockPage& page, ReadWall&& wall) {
  const std::int64_t horizon_ns = page.horizon_ns.load(std::memory_order_acquire);
  const std::int64_t lost_ns = page.lost_ns.load(std::memory_order_acquire);
  const Instant at = wall();
  return {at.ns - lost_ns < horizon_ns ? at.ns - lost_ns : horizon_ns};
}

// Bench time at a moment of the wall clock; exact as long as the later pauses are stored.
inline Instant bench_time_of(const ClockPage& page, Instant wall) {
  const std::uint64_t made = page.pauses_made.load(std::memory_order_acquire);
  const std::int64_t horizon_ns = page.horizon_ns.load(std::memory_order_acquire);
  std::int64_t lost_ns = page.lost_ns.load(std::memory_order_acquire);
  const std::uint64_t known = made < ClockPage::kPauses ? made : ClockPage::kPauses;
  for (std::uint64_t back = 0; back < known; ++back) {
    const ClockPause& pause = page.pauses[(made - 1 - back) % ClockPage::kPauses];
    const std::int64_t from_ns = pause.from_ns.load(std::memory_order_relaxed);
    const std::int64_t to_ns = pause.to_ns.load(std::memory_order_relaxed);
    if (to_ns <= wall.ns) break;
    lost_ns -= to_ns - (from_ns > wall.ns ? from_ns : wall.ns);
  }
  return {wall.ns - lost_ns < horizon_ns ? wall.ns - lost_ns : horizon_ns};
}

}  // namespace pitwall::transport
