// Faults of the machine that the run is on: its clock of the day steps, its disk fills up. Only
// ever in a guest, which nobody else uses and which is thrown away afterwards.
//
//   in     process faults (clock_step, log_disk_full), scenario time; for a disk: a folder on it
//   out    the clock set, the disk full; a list of what was done, in words
//   invariants
//          what has a duration is undone at its end. The full disk is a small file system of its
//          own (mount_disk), filled to the last byte
//   errors Problem: not a guest, not root, no room; nothing has been done then
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "hil/bench/process_script.hpp"
#include "hil/faults/bench_fault.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::bench {

// True in User-mode Linux, as its kernel says.
bool is_guest();

// True for the faults that this file carries out.
bool is_machine_fault(faults::BenchFaultKind kind);

// An empty file system of a few MiB at `folder`, which is made. Guest only.
Result<bool, Problem> mount_disk(const std::string& folder);

class Machine {
 public:
  // `disk`: the folder that log_disk_full fills.
  static Result<Machine, Problem> take(std::span<const faults::BenchFault> faults,
                                       const std::string& disk);
  std::optional<Problem> advance(Instant now);
  const std::vector<Done>& done() const { return done_; }

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
  std::vector<Done> done_;
};

}  // namespace pitwall::bench
