// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/live/virtual_machine.hpp"

#include <fcntl.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <string>

#include "protocol/transport/file.hpp"
#include "protocol/transport/posix_call.hpp"

namespace pitwall::bench {
namespace {

constexpr int kStolenColumn = 8;  // after "cpu": user nice system idle iowait irq softirq steal
constexpr Duration kStep = milliseconds(10);  // USER_HZ is 100 on every architecture we build for

// The line that begins with these words, without them; empty if there is none.
std::string_view line_of(std::string_view text, std::string_view begin) {
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    if (line.starts_with(begin)) return line.substr(begin.size());
    text.remove_prefix(std::min(text.size(), line.size() + 1));
  }
  return {};
}

std::string_view take_word(std::string_view& line) {
  line.remove_prefix(std::min(line.find_first_not_of(" \t:"), line.size()));
  const std::string_view word = line.substr(0, line.find(' '));
  line.remove_prefix(word.size());
  return word;
}

std::string cpuinfo() { return transport::read_file("/proc/cpuinfo").value_or(""); }

// A child of a process with threads may only call what a signal handler may: no memory, no locks.
[[noreturn]] void turn_round(std::size_t processor, pid_t parent) {
  cpu_set_t one;
  CPU_ZERO(&one);
  CPU_SET(processor, &one);
  const sched_param none{};
  const bool settled = prctl(PR_SET_PDEATHSIG, SIGKILL) == 0 && getppid() == parent &&
                       setsid() >= 0 && sched_setaffinity(0, sizeof one, &one) == 0 &&
                       sched_setscheduler(0, SCHED_IDLE, &none) == 0;
  if (!settled) _exit(1);  // at an ordinary priority it would take what others need
  close_range(0, ~0U, 0);
  const int share = open("/proc/self/autogroup", O_WRONLY | O_CLOEXEC);
  constexpr std::string_view kLeast = "19";
  if (share >= 0) static_cast<void>(!write(share, kLeast.data(), kLeast.size()));
  while (true) {
  }
}

}  // namespace

bool is_guest(std::string_view cpuinfo) {
  return cpuinfo.find("User Mode Linux") != std::string_view::npos;
}

bool is_guest() { return is_guest(cpuinfo()); }

bool is_virtual_machine(std::string_view cpuinfo) {
  if (is_guest(cpuinfo)) return false;
  std::string_view flags = line_of(cpuinfo, "flags");
  for (std::string_view word = take_word(flags); !word.empty(); word = take_word(flags))
    if (word == "hypervisor") return true;
  return false;
}

bool is_virtual_machine() { return is_virtual_machine(cpuinfo()); }

std::optional<Duration> stolen_time(std::string_view stat) {
  std::string_view line = line_of(stat, "cpu ");
  std::string_view word;
  for (int column = 0; column < kStolenColumn; ++column) word = take_word(line);
  std::int64_t steps = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), steps);
  if (error != std::errc{} || end != word.data() + word.size()) return std::nullopt;
  return steps * kStep;
}

std::optional<Duration> stolen_time() {
  const auto text = transport::read_file("/proc/stat");
  return text ? stolen_time(*text) : std::nullopt;
}

KeepAwake::KeepAwake(bool needed) {
  cpu_set_t ours;
  if (!needed ||
      !transport::posix_call([&] { return sched_getaffinity(0, sizeof ours, &ours); }).ok())
    return;
  const pid_t parent = getpid();
  for (std::size_t processor = 0; processor < CPU_SETSIZE; ++processor) {
    if (!CPU_ISSET(processor, &ours)) continue;
    const auto child = transport::posix_call([] { return fork(); });
    if (child.ok() && child.value == 0) turn_round(processor, parent);
    if (child.ok()) processes_.push_back(static_cast<pid_t>(child.value));
  }
}

KeepAwake::~KeepAwake() {
  for (const pid_t process : processes_) {
    static_cast<void>(transport::posix_call([&] { return kill(process, SIGKILL); }));
    static_cast<void>(transport::posix_call([&] { return waitpid(process, nullptr, 0); }));
  }
}

}  // namespace pitwall::bench
