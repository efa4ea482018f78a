// Command line and exit codes of every benchmark: those of pitwall-hil.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hil/verbs/command_line.hpp"
#include "hil/verbs/exit_code.hpp"

namespace pitwall::benchmarks {

using verbs::CommandLine;
using verbs::kExitFailed;
using verbs::kExitPass;
using verbs::kExitUnusable;
using verbs::refuse;
using verbs::VerbOption;

}  // namespace pitwall::benchmarks
