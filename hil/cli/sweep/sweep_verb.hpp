// Subcommand `pitwall-hil sweep PLAN`: many cases of one scenario, with other values in it, in
// lockstep and in as many processes as this machine has processors.
//
//   --out FOLDER   what it keeps (hil/sweep/sweep_folder.hpp); default out/sweeps/NAME. The same
//                  sweep in the same folder goes on where it was interrupted
//   --processes N  at a time
//   --engine slurm on a cluster (hil/sweep/slurm_engine.hpp); --sbatch=OPTION for its sbatch
//   --baseline FOLDER  of an earlier sweep of the same plan: not every case has to pass, but those
//                  that passed there
//   --pages N      of so many of the worst cases a page of their own; default 5
//   --case N       this case alone, as `pitwall-hil run` does it
//   --report FOLDER  of that case: log and result with their page
//   out    exit code 0 every case passed, 1 one did not, 2 bad input or the bench failed
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace pitwall::cli {

int sweep_verb(std::span<const std::string> args);

}  // namespace pitwall::cli
