// Subcommand `pitwall-benchmarks radio-gates`: the radio's gates at length, in virtual time.
//   in     --hours: share of the whole lengths and counts (1: an hour of link for the budget);
//          --seed; --json FILE
//   out    a table with gate and figure; the same as JSON
//   errors exit code 1 if a gate is missed, 2 for wrong usage
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace pitwall::benchmarks {

int radio_gates(std::span<const std::string> args);

}  // namespace pitwall::benchmarks
