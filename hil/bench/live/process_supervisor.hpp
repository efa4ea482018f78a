// Process supervisor of a live run, and the actions of the scenario on its processes: kill, stop,
// go on, start again.
//
//   in     a command per role, the script (process_script.hpp), the scenario's time
//   out    running processes; a list of what was done to whom, in words
//   invariants
//          started again = the command for a restart, which is never armed; a process that ends
//          although nobody killed it is an error of the run. At the end whoever is stopped goes on,
//          so that it can be told to end. Who will be started again waits from the beginning on, as
//          a shell that becomes the program at a word: a fork would hold the run up for long
//   errors Problem: a program that cannot be started, one that ended by itself, a script about
//          somebody who is not there
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "hil/bench/process_script.hpp"
#include "protocol/transport/process.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::bench {

struct Member {
  std::vector<std::string> command;  // empty: this role is not played by us
  std::vector<std::string> restart;  // empty: the same
};

class ProcessSupervisor {
 public:
  ProcessSupervisor(std::array<Member, kRoles> members, std::vector<ProcessAction> script)
      : members_(std::move(members)), script_(std::move(script)) {}

  std::optional<Problem> start();
  // Carries out what is due; to be called often, in the order of time.
  std::optional<Problem> advance(Instant now);
  // Somebody who should run and does not.
  std::optional<Problem> missing();
  // Everybody goes on, is told to end (SIGTERM) and waited for; `idle` is called meanwhile.
  std::optional<Problem> finish(Duration patience, const std::function<void()>& idle);

  bool plays(Role role) const { return !member(role).command.empty(); }
  bool was_killed(Role role) const { return state(role).killed; }
  // It ended as told, so what it leaves behind is whole.
  bool ended_well(Role role) const { return state(role).ended_well; }
  const std::vector<Done>& done() const { return done_; }

 private:
  struct Standby {
    transport::Process process;
    transport::FileDescriptor cue;
  };
  struct State {
    std::optional<transport::Process> process;
    std::vector<Standby> understudies;
    bool killed = false;  // at least once
    bool absent = false;  // killed and not started again
    bool ended_well = false;
  };

  const Member& member(Role role) const { return members_[static_cast<std::size_t>(role)]; }
  const State& state(Role role) const { return states_[static_cast<std::size_t>(role)]; }
  State& state(Role role) { return states_[static_cast<std::size_t>(role)]; }
  std::optional<Problem> spawn(Role role);
  std::optional<Problem> prepare(Role role);
  std::optional<Problem> enter(Role role);
  std::optional<Problem> carry_out(const ProcessAction& action);
  void note(const ProcessAction& action, Instant now);
  void ask_to_end();
  bool all_ended();

  std::array<Member, kRoles> members_;
  std::vector<ProcessAction> script_;
  std::size_t next_ = 0;
  std::array<State, kRoles> states_;
  std::vector<Done> done_;
};

}  // namespace pitwall::bench
