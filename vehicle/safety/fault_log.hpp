// Log of the causes that occurred: a ring buffer of (instant, cause, value) that also keeps the
// first stopping cause since the last reset.
//   out    a value type; a copy is a snapshot
//   errors an entry that is overwritten stays counted in `total`
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
  double value = kUnset;  // that exceeded its limit: age in s, sigma in m, count
};

inline constexpr std::size_t kFaultEntries = 64;  // in a longer run only the first entries matter

struct FaultLog {
  std::array<FaultEntry, kFaultEntries> ring{};
  std::uint64_t total = 0;  // newest: ring[(total - 1) % kFaultEntries]
  FaultEntry first{};       // stopping cause since the last reset; kNone if none

  constexpr std::size_t size() const {
    return total < kFaultEntries ? static_cast<std::size_t>(total) : kFaultEntries;
  }
  // Entry 0 is the oldest one kept; i < size().
  constexpr const FaultEntry& entry(std::size_t i) const {
    return ring[static_cast<std::size_t>((total - size() + i) % kFaultEntries)];
  }
  // `stops`: the cause stops a car that moves or is about to, so it may become the first cause.
  constexpr void record(const FaultEntry& fault, bool stops) {
    ring[static_cast<std::size_t>(total % kFaultEntries)] = fault;
    ++total;
    if (stops && first.cause == Cause::kNone) first = fault;
  }
  constexpr void clear_first() { first = FaultEntry{}; }
};
static_assert(std::is_trivially_copyable_v<FaultLog>);

}  // namespace pitwall::safety
