// Command line and exit codes of all benchmarks, the same as those of pitwall-hil.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hil/cli/command_line.hpp"
#include "hil/cli/exit_code.hpp"

namespace pitwall::benchmarks {

using cli::CommandLine;
using cli::kExitFailed;
using cli::kExitPass;
using cli::kExitUnusable;
using cli::refuse;
using cli::VerbOption;

}  // namespace pitwall::benchmarks
