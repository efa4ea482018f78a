// Faults of the machine of the run: a step of its real-time clock, a full disk. Only in a guest,
// which has no other use and is discarded afterwards.
//
//   in     process faults (clock_step, log_disk_full), scenario time; for a disk: a folder on it
//   out    the clock set, the disk full; a list of the actions, in words
//   invariants
//          a fault with a duration is undone at its end. The full disk is a small file system of
//          its own (mount_disk), filled to the last byte
//   errors take(): Problem if this is not a guest or the run has no such disk; nothing has been
//          done then. advance(), mount_disk(): Problem of the system call: not root, no room
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "hil/bench/live/process_script.hpp"
#include "hil/bench/result.hpp"
#include "hil/faults/bench_fault.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::bench {

// True for the faults that this file carries out.
bool is_machine_fault(faults::BenchFaultKind kind);

// Mounts an empty file system of 8 MiB at `folder`, which is created. Guest only.
Result<bool, Problem> mount_disk(const std::string& folder);

class Machine {
 public:
  // `disk`: the folder that log_disk_full fills.
  static Result<Machine, Problem> take(std::span<const faults::BenchFault> faults,
                                       const std::string& disk);
  std::optional<Problem> advance(Instant now);
  const std::vector<CompletedAction>& done() const { return done_; }

 private:
  struct ProcessAction {
    faults::BenchFault fault;
    bool begun = false, ended = false;
  };

  Result<bool, Problem> begin(const faults::BenchFault& fault);
  Result<bool, Problem> undo(const faults::BenchFault& fault);
  std::string filler() const { return disk_ + "/filler"; }

  std::vector<ProcessAction> actions_;
  std::string disk_;
  std::vector<CompletedAction> done_;
};

}  // namespace pitwall::bench
