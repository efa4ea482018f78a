// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/process_script.hpp"

#include <algorithm>
#include <optional>

namespace pitwall::bench {
namespace {

using faults::BenchFault;
using faults::BenchFaultKind;

// Nothing for the faults of the machine, which are nobody's in particular.
std::optional<Role> role_of(BenchFaultKind kind) {
  switch (kind) {
    case BenchFaultKind::kComputerPaused:
    case BenchFaultKind::kComputerKilled:
    case BenchFaultKind::kComputerSlow:
      return Role::kCar;
    case BenchFaultKind::kGuardianKilled:
      return Role::kGuardian;
    case BenchFaultKind::kBaseKilled:
    case BenchFaultKind::kBasePaused:
      return Role::kBase;
    default:
      return std::nullopt;
  }
}

void add_pair(std::vector<Deed>& deeds, const BenchFault& fault, Role role, Act begin, Act end) {
  deeds.push_back({.at = fault.start, .role = role, .act = begin});
  if (fault.duration)
    deeds.push_back({.at = fault.start + *fault.duration, .role = role, .act = end});
}

void add_slow(std::vector<Deed>& deeds, const BenchFault& fault, Role role, Instant end) {
  const Instant until = fault.duration ? std::min(end, fault.start + *fault.duration) : end;
  const Duration stopped = from_seconds(fault.value * kSlowPeriod.seconds());
  for (Instant at = fault.start; at < until; at += kSlowPeriod) {
    deeds.push_back({.at = at,
                     .role = role,
                     .act = Act::kPause,
                     .first_of_many = at == fault.start,
                     .one_of_many = true});
    deeds.push_back({.at = std::min(at + stopped, until),
                     .role = role,
                     .act = Act::kResume,
                     .first_of_many = false,
                     .one_of_many = true});
  }
}

}  // namespace

std::vector<Deed> script_of(std::span<const BenchFault> faults, Instant end) {
  std::vector<Deed> deeds;
  for (const BenchFault& fault : faults) {
    const auto role = role_of(fault.kind);
    if (!role) continue;
    if (fault.kind == BenchFaultKind::kComputerSlow)
      add_slow(deeds, fault, *role, end);
    else if (fault.kind == BenchFaultKind::kComputerPaused ||
             fault.kind == BenchFaultKind::kBasePaused)
      add_pair(deeds, fault, *role, Act::kPause, Act::kResume);
    else
      add_pair(deeds, fault, *role, Act::kKill, Act::kStart);
  }
  std::ranges::stable_sort(deeds, {}, &Deed::at);
  return deeds;
}

bool concerns(std::span<const BenchFault> faults, Role role) {
  return std::ranges::any_of(faults, [&](const BenchFault& f) { return role_of(f.kind) == role; });
}

}  // namespace pitwall::bench
