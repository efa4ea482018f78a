// Scheduling state of a thread of another process, as the kernel reports it.
//   in     process and thread numbers
//   out    its state; the processor time of its process
//   errors none: a thread whose state cannot be read counts as ended
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <string>
#include <string_view>

#include "protocol/vocabulary/time.hpp"

namespace pitwall::transport {

enum class TaskState : std::uint8_t {
  kRuns,     // has a processor or waits for one, or for a disk (R, D)
  kWaits,    // sleeps on its own (S, I)
  kStopped,  // by a signal or a debugger (T, t)
  kGone,     // ended (Z, X, no such thread)
};

// State in the text of /proc/PID/task/TID/stat; the name in brackets may contain any characters.
TaskState task_state(std::string_view stat);
TaskState task_state(pid_t process, pid_t thread);
// Processor time of all threads of a process; zero if the process has ended.
Duration process_time(pid_t process);
// Name of a process as `ps` shows it; empty if the process has ended.
std::string task_name(pid_t process);

}  // namespace pitwall::transport
