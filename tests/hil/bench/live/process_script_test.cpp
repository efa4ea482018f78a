// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/live/process_script.hpp"

#include <gtest/gtest.h>

#include <map>
#include <string>

namespace pitwall::bench {
namespace {

using faults::BenchFault;
using enum faults::BenchFaultKind;

constexpr Instant kEnd = Instant{} + seconds(60);

BenchFault at(faults::BenchFaultKind kind, Duration start, std::optional<Duration> lasts,
              double value = 0.0) {
  return {.kind = kind, .start = Instant{} + start, .duration = lasts, .value = value};
}

// "10.000 0 0": when, who, what.
std::vector<std::string> lines(const std::vector<ProcessAction>& actions) {
  std::vector<std::string> out;
  for (const ProcessAction& action : actions)
    out.push_back(std::to_string((action.at - Instant{}).ns / 1'000'000) + " " +
                  std::string(kRoleNames[static_cast<std::size_t>(action.role)]) + " " +
                  std::string(kActNames[static_cast<std::size_t>(action.act)]));
  return out;
}

TEST(ProcessScript, AKillForAWhileEndsInAStartAndOneForEverDoesNot) {
  const std::vector faults{at(kBaseKilled, seconds(20), seconds(5)),
                           at(kComputerKilled, seconds(10), std::nullopt),
                           at(kGuardianKilled, seconds(21), std::nullopt)};
  EXPECT_EQ(lines(script_of(faults, kEnd)),
            (std::vector<std::string>{
                "10000 car killed (SIGKILL)", "20000 base station killed (SIGKILL)",
                "21000 guardian killed (SIGKILL)", "25000 base station started again, not armed"}));
}

TEST(ProcessScript, APauseEndsInGoingOn) {
  const std::vector faults{at(kComputerPaused, seconds(10), milliseconds(200)),
                           at(kBasePaused, seconds(10), std::nullopt)};
  EXPECT_EQ(lines(script_of(faults, kEnd)),
            (std::vector<std::string>{"10000 car stopped (SIGSTOP)",
                                      "10000 base station stopped (SIGSTOP)",
                                      "10200 car goes on (SIGCONT)"}));
}

TEST(ProcessScript, ASlowedProcessIsStoppedForItsShareAndRunsAtTheEnd) {
  for (const double share : {0.1, 0.5, 0.9}) {
    for (const auto& lasts : {std::optional<Duration>{milliseconds(1'010)},
                              std::optional<Duration>{seconds(7)}, std::optional<Duration>{}}) {
      const std::vector faults{at(kComputerSlow, seconds(57), lasts, share)};
      const auto actions = script_of(faults, kEnd);
      Duration stopped{};
      bool running = true;
      Instant since{};
      int reported = 0;
      for (const ProcessAction& action : actions) {
        EXPECT_EQ(action.act, running ? Act::kPause : Act::kResume) << "they alternate";
        if (!running) stopped = stopped + (action.at - since);
        running = !running;
        since = action.at;
        reported += action.first_of_many || !action.one_of_many ? 1 : 0;
      }
      EXPECT_TRUE(running);
      EXPECT_EQ(reported, 1);
      const Instant until = lasts ? std::min(kEnd, Instant{} + seconds(57) + *lasts) : kEnd;
      EXPECT_LE(actions.back().at, until);
      const double whole_s = (until - (Instant{} + seconds(57))).seconds();
      EXPECT_NEAR(stopped.seconds(), share * whole_s, kSlowPeriod.seconds());
    }
  }
}

TEST(ProcessScript, WhatIsDoneToTheMachineIsDoneToNobody) {
  const std::vector faults{at(kClockStep, seconds(1), std::nullopt, 3600.0),
                           at(kLogDiskFull, seconds(1), std::nullopt)};
  EXPECT_TRUE(script_of(faults, kEnd).empty());
  for (const Role role : {Role::kCar, Role::kGuardian, Role::kBase})
    EXPECT_FALSE(concerns(faults, role));
}

TEST(ProcessScript, AFaultConcernsOneRoleOnly) {
  const std::map<faults::BenchFaultKind, Role> whom{
      {kComputerPaused, Role::kCar}, {kComputerKilled, Role::kCar},
      {kComputerSlow, Role::kCar},   {kGuardianKilled, Role::kGuardian},
      {kBaseKilled, Role::kBase},    {kBasePaused, Role::kBase}};
  for (const auto& [kind, role] : whom) {
    const std::vector faults{at(kind, seconds(1), seconds(1), 0.5)};
    for (const Role other : {Role::kCar, Role::kGuardian, Role::kBase})
      EXPECT_EQ(concerns(faults, other), other == role) << faults::row_of(kind).name;
  }
}

}  // namespace
}  // namespace pitwall::bench
