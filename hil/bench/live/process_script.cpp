// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/live/process_script.hpp"

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

void add_pair(std::vector<ProcessAction>& actions, const BenchFault& fault, Role role, Act begin,
              Act end) {
  actions.push_back({.at = fault.start, .role = role, .act = begin});
  if (fault.duration)
    actions.push_back({.at = fault.start + *fault.duration, .role = role, .act = end});
}

void add_slow(std::vector<ProcessAction>& actions, const BenchFault& fault, Role role,
              Instant end) {
  const Instant until = fault.duration ? std::min(end, fault.start + *fault.duration) : end;
  const Duration stopped = from_seconds(fault.value * kSlowPeriod.seconds());
  for (Instant at = fault.start; at < until; at += kSlowPeriod) {
    actions.push_back({.at = at,
                       .role = role,
                       .act = Act::kPause,
                       .first_of_many = at == fault.start,
                       .one_of_many = true});
    actions.push_back({.at = std::min(at + stopped, until),
                       .role = role,
                       .act = Act::kResume,
                       .first_of_many = false,
                       .one_of_many = true});
  }
}

}  // namespace

std::vector<ProcessAction> script_of(std::span<const BenchFault> faults, Instant end) {
  std::vector<ProcessAction> actions;
  for (const BenchFault& fault : faults) {
    const auto role = role_of(fault.kind);
    if (!role) continue;
    if (fault.kind == BenchFaultKind::kComputerSlow)
      add_slow(actions, fault, *role, end);
    else if (fault.kind == BenchFaultKind::kComputerPaused ||
             fault.kind == BenchFaultKind::kBasePaused)
      add_pair(actions, fault, *role, Act::kPause, Act::kResume);
    else
      add_pair(actions, fault, *role, Act::kKill, Act::kStart);
  }
  std::ranges::stable_sort(actions, {}, &ProcessAction::at);
  return actions;
}

bool concerns(std::span<const BenchFault> faults, Role role) {
  return std::ranges::any_of(faults, [&](const BenchFault& f) { return role_of(f.kind) == role; });
}

}  // namespace pitwall::bench
