// What the host of a virtual machine did to a run in real time. On each processor a thread of the
// highest priority sleeps for moments and looks how late it wakes: nothing of this machine may run
// before it, so it comes late where the processor was not there.
//   in     processors that this process may use; the time that the kernel counts as stolen
//   out    Stalls: wake-ups more than 15 ms late, how many, the worst, all together
//   law    spoiled: a run whose bench may be 40 ms late at most cannot do better than such a thread
//   errors none: where SCHED_FIFO is refused our own work delays the threads, too; then, and on a
//          machine that says nothing of stolen time, only what was stolen is the host's
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "protocol/vocabulary/time.hpp"

namespace pitwall::testing {

struct Stalls {
  int count = 0;
  Duration worst{}, together{};
  Duration stolen{};   // by the kernel's account, of all processors together
  Duration watched{};  // of all processors together
};

bool spoiled(const Stalls& stalls);
std::string to_string(const Stalls& stalls);

class StallWatch {
 public:
  StallWatch();
  Stalls seen() const;
  Instant last_stall() const;  // the start of the watch, where there was none

 private:
  void look(int processor, const std::stop_token& stop);
  void add(Duration late, Instant now);

  mutable std::mutex mutex_;
  Stalls stalls_;
  Instant from_{}, last_stall_{};
  Duration stolen_before_{};
  std::vector<std::jthread> threads_;  // last: they end first
};

}  // namespace pitwall::testing
