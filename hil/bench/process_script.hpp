// Timed actions on the processes of a live run, from the faults of its scenario. Pure.
//   in     process faults, end of the run
//   out    deeds in the order of time; of equal instants in the order of the scenario
//   invariants
//          killed for a duration: started again at its end; paused: goes on at its end; slow: in
//          every kSlowPeriod first stopped for the share, then running. What has no duration lasts
//          until the end of the run
//   errors none: plan_faults() has judged the values
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
  bool first_of_many = false, one_of_many = false;  // of a slowed process: told once
};

// What was really done, and when, for the event log and the result.
struct Done {
  Instant at{};
  std::string what;
};

std::vector<ProcessAction> script_of(std::span<const faults::BenchFault> faults, Instant end);

// Whom the faults are about.
bool concerns(std::span<const faults::BenchFault> faults, Role role);

}  // namespace pitwall::bench
