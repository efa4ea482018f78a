// The log of the causes that occurred: a ring of (instant, cause, value) that also keeps the first
// since the last reset.
//   out    a value; copying it is a snapshot
//   errors an entry that falls out of the ring stays counted in total
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/safety/causes.hpp"

namespace pitwall::safety {

struct FaultEntry {
  Instant at{};
  Cause cause = Cause::kNone;
  double value = kUnset;  // age in s, sigma in m, count: what crossed its limit
};

inline constexpr std::size_t kFaultEntries = 64;  // a run that has more has one cause worth reading

struct FaultLog {
  std::array<FaultEntry, kFaultEntries> ring{};
  std::uint64_t total = 0;  // ever recorded; the newest is ring[(total - 1) % kFaultEntries]
  FaultEntry first{};  // that stopped the car since the last reset; cause kNone if there is none

  constexpr std::size_t size() const {
    return total < kFaultEntries ? static_cast<std::size_t>(total) : kFaultEntries;
  }
  // 0 is the oldest kept; i < size().
  constexpr const FaultEntry& entry(std::size_t i) const {
    return ring[static_cast<std::size_t>((total - size() + i) % kFaultEntries)];
  }
  // `stops`: the car was to move, so the fault is a candidate for the first cause.
  constexpr void record(const FaultEntry& fault, bool stops) {
    ring[static_cast<std::size_t>(total % kFaultEntries)] = fault;
    ++total;
    if (stops && first.cause == Cause::kNone) first = fault;
  }
  constexpr void forget_first() { first = FaultEntry{}; }
};
static_assert(std::is_trivially_copyable_v<FaultLog>);

}  // namespace pitwall::safety
