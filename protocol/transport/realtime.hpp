// Asks the kernel for what a real-time loop wants, and says what it got.
//   in     SCHED_FIFO priority 1..99 for the calling thread
//   out    what was granted; the program runs on either way and the report is shown to people.
//          Timers of the calling thread become exact in any case (no timer slack). Threads and
//          processes that it starts are ordinary ones: they ask for themselves
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sched.h>
#include <sys/types.h>

#include <string>

namespace pitwall::transport {

struct RealtimeReport {
  bool memory_locked = false;  // mlockall of present and future pages
  bool fifo = false;           // SCHED_FIFO at the asked priority
  int memory_error = 0;        // errno of the refusal
  int fifo_error = 0;
};

RealtimeReport request_realtime(int priority);
// Back to an ordinary thread: what it may take again lies unlocked and time-shared.
void release_realtime();
// Another process, and what it starts from now on, before ordinary ones that want the same
// processor. False: not allowed here.
bool prefer(pid_t process);
// For a thread whose work may wait: it, and threads that it starts, run after the ordinary ones
// where they want the same processor.
void give_way();
// Only the memory lock.
bool lock_memory();
// What was freed goes back to the kernel: after reading something large that is needed no more.
void return_free_memory();
std::string to_string(const RealtimeReport& report);

// While it lives the calling thread has one processor, the n-th of those that it may use, counted
// round (-1 is the last); so have, for good, the threads and processes that it starts meanwhile.
// What stops that processor stops them all alike: none of them can take another for dead.
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
