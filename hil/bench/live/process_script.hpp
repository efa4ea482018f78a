// Timed actions on the processes of a live run, made from the faults of its scenario. Pure.
//   in     process faults, end of the run
//   out    actions in order of time; at equal times in the order of the scenario
//   invariants
//          killed for a duration: restarted at the end of the fault; paused: continued at the end;
//          slow: in every kSlowPeriod first stopped for the share `value`, then running. A fault
//          without duration lasts until the end of the run
//   errors none: plan_faults() has checked the values
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hil/faults/bench_fault.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::bench {

inline constexpr Duration kSlowPeriod = milliseconds(50);

enum class Role : std::uint8_t { kCar, kGuardian, kBase };
inline constexpr std::size_t kRoles = 3;
inline constexpr std::string_view kRoleNames[kRoles] = {"car", "guardian", "base station"};

enum class Act : std::uint8_t { kKill, kStart, kPause, kResume };
inline constexpr std::string_view kActNames[] = {"killed (SIGKILL)", "started again, not armed",
                                                 "stopped (SIGSTOP)", "goes on (SIGCONT)"};

struct ProcessAction {
  Instant at{};
  Role role = Role::kCar;
  Act act = Act::kKill;
  bool first_of_many = false, one_of_many = false;  // pauses of a slowed process: reported once
};

std::vector<ProcessAction> script_of(std::span<const faults::BenchFault> faults, Instant end);

// True if one of the faults acts on the process of this role.
bool concerns(std::span<const faults::BenchFault> faults, Role role);

}  // namespace pitwall::bench
