// Process supervisor of a live run, and the actions of the scenario on its processes: kill, stop,
// continue, restart.
//
//   in     a command per role, the script (process_script.hpp), the scenario's time
//   out    running processes; a list of the actions, in words
//   invariants
//          a restart uses the restart command, which never arms the car; a process that ends
//          without being killed is an error of the run. At the end stopped processes are continued,
//          so that they can end on SIGTERM. A process for a later restart waits from the beginning
//          on, as a shell that executes the program on a line of input, because a fork would delay
//          the run
//   errors Problem: a program that cannot be started, one that ended by itself, a script with a
//          role that this run does not have
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "hil/bench/live/process_script.hpp"
#include "hil/bench/result.hpp"
#include "protocol/transport/process.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::bench {

struct Member {
  std::vector<std::string> command;  // empty: not started by the bench
  std::vector<std::string> restart;  // must be set if the script restarts this role
};

class ProcessSupervisor {
 public:
  ProcessSupervisor(std::array<Member, kRoles> members, std::vector<ProcessAction> script)
      : members_(std::move(members)), script_(std::move(script)) {}

  std::optional<Problem> start();
  // Carries out the actions that are due; call it often, with rising times.
  std::optional<Problem> advance(Instant now);
  // Problem with a process that should run and has ended.
  std::optional<Problem> missing();
  // Time for a process to end: it syncs its files first, which takes a busy disk seconds.
  static constexpr Duration kStopLimit = seconds(30);
  // Continues all processes, sends SIGTERM and waits for their end; calls `idle` meanwhile.
  std::optional<Problem> finish(Duration timeout, const std::function<void()>& idle);

  bool has_role(Role role) const { return !member(role).command.empty(); }
  // The script has an action on it.
  bool acts_on(Role role) const;
  bool was_killed(Role role) const { return state(role).killed; }
  // The process ended on request with success, so that its files are complete.
  bool ended_well(Role role) const { return state(role).ended_well; }
  const std::vector<CompletedAction>& done() const { return done_; }

 private:
  struct Standby {
    transport::Process process;
    transport::FileDescriptor start_pipe;
  };
  struct State {
    std::optional<transport::Process> process;
    std::vector<Standby> standbys;
    bool killed = false;  // at least once
    bool absent = false;  // killed and not started again
    bool ended_well = false;
  };

  const Member& member(Role role) const { return members_[static_cast<std::size_t>(role)]; }
  const State& state(Role role) const { return states_[static_cast<std::size_t>(role)]; }
  State& state(Role role) { return states_[static_cast<std::size_t>(role)]; }
  std::optional<Problem> spawn(Role role);
  std::optional<Problem> prepare(Role role);
  std::optional<Problem> start_standby(Role role);
  std::optional<Problem> carry_out(const ProcessAction& action);
  void note(const ProcessAction& action, Instant now);
  void request_end();
  bool all_ended();

  std::array<Member, kRoles> members_;
  std::vector<ProcessAction> script_;
  std::size_t next_ = 0;
  std::array<State, kRoles> states_;
  std::vector<CompletedAction> done_;
};

}  // namespace pitwall::bench
