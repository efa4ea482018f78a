// SPDX-License-Identifier: Apache-2.0
#include "protocol/transport/bench_clock/task_state.hpp"

#include <fcntl.h>

#include <array>
#include <cstdio>
#include <ctime>

#include "protocol/transport/posix_call.hpp"

namespace pitwall::transport {
namespace {

// A file of /proc, as far as it fits.
template <std::size_t kSize>
std::string_view read_small(const char* path, std::array<char, kSize>& into) {
  const FileDescriptor file{posix_call([&] { return ::open(path, O_RDONLY | O_CLOEXEC); })};
  if (!file.valid()) return {};
  const auto got = posix_call([&] { return ::read(file.get(), into.data(), into.size()); });
  return got.ok() ? std::string_view{into.data(), static_cast<std::size_t>(got.value)}
                  : std::string_view{};
}

}  // namespace

TaskState task_state(std::string_view stat) {
  const std::size_t name_end = stat.rfind(") ");
  if (name_end == std::string_view::npos || name_end + 2 >= stat.size()) return TaskState::kGone;
  switch (stat[name_end + 2]) {
    case 'R':
    case 'D':
      return TaskState::kRuns;
    case 'T':
    case 't':
      return TaskState::kStopped;
    case 'S':
    case 'I':
      return TaskState::kWaits;
    default:
      return TaskState::kGone;
  }
}

TaskState task_state(pid_t process, pid_t thread) {
  std::array<char, 64> path{};
  std::snprintf(path.data(), path.size(), "/proc/%d/task/%d/stat", process, thread);
  std::array<char, 128> text{};
  return task_state(read_small(path.data(), text));
}

Duration process_time(pid_t process) {
  clockid_t clock{};
  timespec t{};
  if (::clock_getcpuclockid(process, &clock) != 0) return {};
  if (::clock_gettime(clock, &t) != 0) return {};
  return {t.tv_sec * kNanosecondsPerSecond + t.tv_nsec};
}

std::string task_name(pid_t process) {
  std::array<char, 64> path{}, text{};
  std::snprintf(path.data(), path.size(), "/proc/%d/comm", process);
  std::string name{read_small(path.data(), text)};
  while (!name.empty() && name.back() == '\n') name.pop_back();
  return name;
}

}  // namespace pitwall::transport
