// A machine whose processors are lent to it by a host, and what real time costs there.
//   in     what the kernel says of its processors (/proc/cpuinfo) and of their time (/proc/stat)
//   out    whether the machine is a virtual one; the time that its host kept from it; KeepAwake
//   invariants
//          A host runs the processors of its guests in turn. One that falls asleep joins the end
//          of a line when it wakes, some milliseconds long where the host is busy, a hundred times
//          a second; one that never sleeps loses little. So a process of lowest priority keeps each
//          busy ("idle=poll" of the kernel's parameters, for as long as it is wanted)
//   errors none: a machine that cannot be read is no virtual one, its stolen time is unset
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "protocol/vocabulary/time.hpp"

namespace pitwall::transport {

// A User-mode Linux is none: its processor is a process of the host, which sleeps as those do.
bool is_virtual_machine(std::string_view cpuinfo);
bool is_virtual_machine();

// Of all processors together since the start of the machine, in steps of 10 ms: they had work, and
// the host ran others.
std::optional<Duration> stolen_time(std::string_view stat);
std::optional<Duration> stolen_time();

// While it lives, no processor of a virtual machine sleeps: a process on each that this one may use
// turns round, of the lowest priority in a session of the lowest share (SCHED_IDLE holds within a
// session alone, see sched(7) on autogroups). Elsewhere it does nothing.
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

}  // namespace pitwall::transport
