// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/live/process_supervisor.hpp"

#include <unistd.h>

#include <algorithm>
#include <csignal>

#include "protocol/transport/clock.hpp"
#include "protocol/transport/posix_call.hpp"
#include "protocol/transport/stream/serial_line.hpp"
#include "protocol/vocabulary/check.hpp"

namespace pitwall::bench {
namespace {

using transport::Process;

constexpr std::array kEveryRole{Role::kCar, Role::kGuardian, Role::kBase};

std::string name_of(Role role) { return std::string(kRoleNames[static_cast<std::size_t>(role)]); }

}  // namespace

std::optional<Problem> ProcessSupervisor::start() {
  for (const ProcessAction& action : script_)
    if (!has_role(action.role))
      return Problem{name_of(action.role), "a fault acts on this process, but the run has none"};
  for (const ProcessAction& action : script_)
    if (action.act == Act::kStart)
      if (auto problem = prepare(action.role)) return problem;
  for (const Role role : kEveryRole)
    if (has_role(role))
      if (auto problem = spawn(role)) return problem;
  return std::nullopt;
}

std::optional<Problem> ProcessSupervisor::spawn(Role role) {
  auto process = Process::spawn({.argv = member(role).command});
  if (!process) return process.error();
  state(role).process.emplace(*std::move(process));
  return std::nullopt;
}

std::optional<Problem> ProcessSupervisor::prepare(Role role) {
  auto line = transport::stream_pair();
  if (!line) return line.error();
  std::vector<std::string> argv{"/bin/sh", "-c", "read -r _ && exec \"$@\" < /dev/null", "sh"};
  const std::vector<std::string>& command = member(role).restart;
  argv.insert(argv.end(), command.begin(), command.end());
  auto process = Process::spawn({.argv = argv, .descriptors = {{line->second.get(), 0}}});
  if (!process) return process.error();
  state(role).standbys.push_back({*std::move(process), std::move(line->first)});
  return std::nullopt;
}

std::optional<Problem> ProcessSupervisor::start_standby(Role role) {
  State& whom = state(role);
  CHECK(!whom.standbys.empty());
  Standby next = std::move(whom.standbys.back());
  whom.standbys.pop_back();
  if (!whom.absent) return std::nullopt;
  const auto reported =
      transport::posix_call([&] { return ::write(next.start_pipe.get(), "\n", 1); });
  if (!reported.ok()) return Problem{name_of(role), reported.reason()};
  whom.process.emplace(std::move(next.process));
  whom.absent = false;
  return std::nullopt;
}

std::optional<Problem> ProcessSupervisor::advance(Instant now) {
  for (; next_ < script_.size() && script_[next_].at <= now; ++next_) {
    if (auto problem = carry_out(script_[next_])) return problem;
    note(script_[next_], now);
  }
  return std::nullopt;
}

std::optional<Problem> ProcessSupervisor::carry_out(const ProcessAction& action) {
  State& whom = state(action.role);
  switch (action.act) {
    case Act::kKill:
      whom.killed = whom.absent = true;
      whom.process->kill(SIGKILL);
      return std::nullopt;
    case Act::kStart:
      return start_standby(action.role);
    case Act::kPause:
      whom.process->kill(SIGSTOP);
      return std::nullopt;
    case Act::kResume:
      whom.process->kill(SIGCONT);
      return std::nullopt;
  }
  CHECK(false);
}

void ProcessSupervisor::note(const ProcessAction& action, Instant now) {
  if (action.one_of_many && !action.first_of_many) return;
  const auto act = kActNames[static_cast<std::size_t>(action.act)];
  done_.push_back({now, name_of(action.role) + " " + std::string(act) +
                            (action.first_of_many ? ", again and again" : "")});
}

bool ProcessSupervisor::acts_on(Role role) const {
  return std::ranges::find(script_, role, &ProcessAction::role) != script_.end();
}

std::optional<Problem> ProcessSupervisor::missing() {
  for (const Role role : kEveryRole) {
    State& one = state(role);
    if (!one.process || one.absent) continue;
    if (const auto ended = one.process->poll())
      return Problem{member(role).command.front(), "the " + name_of(role) + " ended with code " +
                                                       std::to_string(ended->shell_code()) +
                                                       " before the run was over"};
  }
  return std::nullopt;
}

void ProcessSupervisor::request_end() {
  for (State& one : states_) {
    if (!one.process) continue;
    one.process->kill(SIGCONT);
    one.process->kill(SIGTERM);
  }
}

bool ProcessSupervisor::all_ended() {
  return std::ranges::all_of(states_,
                             [](State& one) { return !one.process || one.process->poll(); });
}

std::optional<Problem> ProcessSupervisor::finish(Duration timeout,
                                                 const std::function<void()>& idle) {
  request_end();
  const Instant limit = transport::monotonic_now() + timeout;
  while (!all_ended() && transport::monotonic_now() < limit) idle();
  for (const Role role : kEveryRole) {
    State& one = state(role);
    if (!one.process) continue;
    const auto ended = one.process->poll();
    if (!ended)
      return Problem{member(role).command.front(), "the " + name_of(role) + " did not stop"};
    one.ended_well = ended->success();
  }
  return std::nullopt;
}

}  // namespace pitwall::bench
