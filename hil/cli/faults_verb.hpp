// Subcommand `pitwall-hil faults [--only NAME] [--without MONITOR]... [--prove] [--json FILE]`:
// runs every fault of the catalogue in lockstep and reports which monitor detects it and how fast.
//
//   in     hil/scenarios/faults/*.yaml; two runs at a time
//   out    the matrix of hil/cli/fault_coverage/fault_matrix.hpp. --without: with these monitors
//          switched off. --prove: in addition each monitor is switched off once, and a scenario
//          that requires it must then fail
//   errors exit code 1: a fault is missed or not covered, an outcome is unsafe, a monitor is
//          unproven; 2: bad input
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace pitwall::cli {

int faults_verb(std::span<const std::string> args);

}  // namespace pitwall::cli
