// Real-time settings of threads and processes: locked memory, SCHED_FIFO, priorities, affinity.
//   in     SCHED_FIFO priority 1..99 for the calling thread
//   out    report of the granted settings, for operators; the program runs on without them too.
//          The timers of the calling thread become exact in any case (no timer slack). Threads and
//          processes that it starts are ordinary ones and make their own requests
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sched.h>
#include <sys/types.h>

#include <string>

namespace pitwall::transport {

struct RealtimeReport {
  bool memory_locked = false;  // mlockall of present and future pages
  bool fifo = false;           // SCHED_FIFO at the requested priority
  int memory_error = 0;        // errno of the refusal
  int fifo_error = 0;
};

RealtimeReport request_realtime(int priority);
// Makes the calling thread an ordinary, time-shared one and unlocks the memory of the process.
void release_realtime();
// Raises the priority of another process, and of those that it starts from now on, above ordinary
// ones on the same processor. False: not permitted.
bool raise_priority(pid_t process);
// Lowers the priority of the calling thread, and of threads that it starts, below ordinary ones on
// the same processor.
void lower_priority();
// Locks present and future pages only.
bool lock_memory();
// Returns freed memory to the kernel, for example after reading a large file.
void return_free_memory();
std::string to_string(const RealtimeReport& report);

// Scope in which the calling thread runs on one processor: the n-th of its allowed ones, modulo
// their number (-1 is the last). Threads and processes that it starts in the scope stay there. A
// stop of that processor stops them all, so that none of them takes another one for dead.
class OnOneProcessor {
 public:
  explicit OnOneProcessor(int n);
  ~OnOneProcessor();
  OnOneProcessor(const OnOneProcessor&) = delete;
  OnOneProcessor& operator=(const OnOneProcessor&) = delete;

 private:
  cpu_set_t before_{};
};

}  // namespace pitwall::transport
