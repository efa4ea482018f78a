// Runs the cases of a sweep in processes of this machine: some cases each, so many at a time.
//   in     cases to run; what starts a process for some of them and where it puts their results
//   out    every case has a result in the folder: one whose process ended without, twice, has
//          crashed. Between processes `progress` is told
//   law    the results do not depend on the number of processes
//   errors Problem if a process cannot be started or a result not be read or written; what has
//          ended by then is in the folder
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "hil/sweep/sweep_folder.hpp"
#include "protocol/transport/process.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::sweep {

struct LocalEngine {
  unsigned processes = 1;  // at a time
  // A process that appends the results of these cases to the folder under this name.
  std::function<Result<transport::Process, Problem>(const CaseNumbers&, const std::string& name)>
      start;
  std::function<void(std::size_t done)> progress;  // of those that were to run
};

Result<bool, Problem> run_here(const CaseNumbers& cases, std::size_t all, const SweepFolder& folder,
                               const LocalEngine& engine);

}  // namespace pitwall::sweep
