// Scheduling state of a thread of another process, by the kernel: running, runnable, waiting or
// stopped.
//   in     process and thread numbers
//   out    its state; the processor time of its process
//   errors none: who cannot be asked is gone
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
  kWaits,    // for something of its own (S, I)
  kStopped,  // by a signal or a debugger (T, t)
  kGone,     // ended (Z, X, no such thread)
};

// Of the text of /proc/PID/task/TID/stat; the name in brackets may hold anything.
TaskState task_state(std::string_view stat);
TaskState task_state(pid_t process, pid_t thread);
// Processor time that all threads of a process have had; zero of one that is gone.
Duration process_time(pid_t process);
// As `ps` names it; empty of one that is gone.
std::string task_name(pid_t process);

}  // namespace pitwall::transport
