// Detection of a virtual machine, its steal time, and idle load that keeps its processors awake.
//   in     /proc/cpuinfo (processors) and /proc/stat (their times)
//   out    whether the machine is a guest of the bench, or another virtual one; the time that its
//          host took from it; KeepAwake
//   invariants
//          A host schedules the processors of its guests in turn. A processor that sleeps waits for
//          its turn at each wake-up, some milliseconds on a busy host, a hundred times per second;
//          one that never sleeps loses little. So a process of lowest priority keeps each processor
//          busy (like the kernel parameter "idle=poll", while KeepAwake exists)
//   errors none: if the files cannot be read, the machine counts as not virtual and its steal time
//          is empty
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "protocol/vocabulary/time.hpp"

namespace pitwall::bench {

// True in User-mode Linux, which the bench starts as its guest.
bool is_guest(std::string_view cpuinfo);
bool is_guest();

// False in a guest of the bench: its processor is a process of the host and sleeps as such.
bool is_virtual_machine(std::string_view cpuinfo);
bool is_virtual_machine();

// Steal time of all processors together since the start of the machine, in steps of 10 ms: they had
// work, but the host ran other guests.
std::optional<Duration> stolen_time(std::string_view stat);
std::optional<Duration> stolen_time();

// Scope in which no processor of a virtual machine sleeps: on each one that this process may use, a
// process spins at the lowest priority in a session of the lowest share (SCHED_IDLE holds only
// within a session, see sched(7) on autogroups). On other machines it has no effect.
class KeepAwake {
 public:
  KeepAwake() : KeepAwake(is_virtual_machine()) {}
  explicit KeepAwake(bool needed);
  ~KeepAwake();
  KeepAwake(const KeepAwake&) = delete;
  KeepAwake& operator=(const KeepAwake&) = delete;

  std::span<const pid_t> processes() const { return processes_; }

 private:
  std::vector<pid_t> processes_;
};

}  // namespace pitwall::bench
