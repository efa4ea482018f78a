// Runs the cases of a sweep on a Slurm cluster, as array jobs of some cases a task. The folder of
// the sweep, the program and its files are at the same paths on every node.
//   in     cases to run; the program with its arguments for a process of the sweep
//   out    every case has a result in the folder. What a job leaves without one goes into another
//          job, alone; what two of these leave has crashed. A node that is lost costs nothing:
//          Slurm runs its tasks elsewhere, and these leave out the cases that they have done
//   law    a sweep that is begun again while its job is queued or runs waits for that job first
//   errors Problem with what `sbatch` or `squeue` says, or if all that is left is held; what has
//          ended is in the folder
//   format slurm/job: number of the job and of its tasks; slurm/shares-N: cases of each task
//   source sbatch(1), squeue(1), Slurm 22.05
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "hil/sweep/local_engine.hpp"
#include "hil/sweep/sweep_folder.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::sweep {

// Tasks of an array job, below Slurm's own limit as installed (MaxArraySize 1001).
inline constexpr std::size_t kTasksMost = 1'000;

struct SlurmEngine {
  // A process of the sweep; its name and cases follow as --worker NAME --cases A,B.
  std::vector<std::string> command;
  std::vector<std::string> options{};  // of sbatch
  std::function<void(std::size_t tasks_left, std::size_t tasks)> progress{};
  std::size_t tasks_most = kTasksMost;  // of a job
};

Result<bool, Problem> run_on_cluster(const CaseNumbers& cases, std::size_t all,
                                     const SweepFolder& folder, const SlurmEngine& engine);

// Whether this machine has Slurm's commands; the Problem says which packages bring them.
Result<bool, Problem> find_slurm();

}  // namespace pitwall::sweep
