// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/cast.hpp"

#include <algorithm>
#include <csignal>

#include "protocol/transport/clock.hpp"
#include "protocol/vocabulary/check.hpp"

namespace pitwall::bench {
namespace {

using transport::Process;

constexpr std::array kEveryRole{Role::kCar, Role::kGuardian, Role::kBase};

std::string name_of(Role role) { return std::string(kRoleNames[static_cast<std::size_t>(role)]); }

}  // namespace

std::optional<Problem> Cast::start() {
  for (const Deed& deed : script_)
    if (!plays(deed.role))
      return Problem{name_of(deed.role), "a fault is about it, but this run has none"};
  for (const Role role : kEveryRole) {
    if (!plays(role)) continue;
    if (auto problem = spawn(role, member(role).command)) return problem;
  }
  return std::nullopt;
}

std::optional<Problem> Cast::spawn(Role role, const std::vector<std::string>& command) {
  auto process = Process::spawn({.argv = command});
  if (!process) return process.error();
  state(role).process.emplace(*std::move(process));
  state(role).absent = false;
  return std::nullopt;
}

std::optional<Problem> Cast::advance(Instant now) {
  for (; next_ < script_.size() && script_[next_].at <= now; ++next_) {
    if (auto problem = carry_out(script_[next_])) return problem;
    note(script_[next_], now);
  }
  return std::nullopt;
}

std::optional<Problem> Cast::carry_out(const Deed& deed) {
  State& whom = state(deed.role);
  switch (deed.act) {
    case Act::kKill:
      whom.killed = whom.absent = true;
      whom.process->kill(SIGKILL);
      whom.process->wait();  // SIGKILL waits for nobody, not even for a stopped process
      return std::nullopt;
    case Act::kStart:
      if (!whom.absent) return std::nullopt;
      return spawn(deed.role, member(deed.role).restart);
    case Act::kPause:
      whom.process->kill(SIGSTOP);
      return std::nullopt;
    case Act::kResume:
      whom.process->kill(SIGCONT);
      return std::nullopt;
  }
  CHECK(false);
}

void Cast::note(const Deed& deed, Instant now) {
  if (deed.one_of_many && !deed.first_of_many) return;
  const auto act = kActNames[static_cast<std::size_t>(deed.act)];
  done_.push_back({now, name_of(deed.role) + " " + std::string(act) +
                            (deed.first_of_many ? ", again and again" : "")});
}

std::optional<Problem> Cast::missing() {
  for (const Role role : kEveryRole) {
    State& one = state(role);
    if (!one.process || one.absent) continue;
    if (const auto ended = one.process->poll())
      return Problem{member(role).command.front(), "the " + name_of(role) + " ended with code " +
                                                       std::to_string(ended->shell_code()) +
                                                       " although nobody asked it to"};
  }
  return std::nullopt;
}

void Cast::ask_to_end() {
  for (State& one : states_) {
    if (!one.process) continue;
    one.process->kill(SIGCONT);
    one.process->kill(SIGTERM);
  }
}

bool Cast::all_ended() {
  return std::ranges::all_of(states_,
                             [](State& one) { return !one.process || one.process->poll(); });
}

std::optional<Problem> Cast::finish(Duration patience, const std::function<void()>& idle) {
  ask_to_end();
  const Instant limit = transport::monotonic_now() + patience;
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
