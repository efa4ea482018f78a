// `pitwall-benchmarks radio-gates`: the radio's gates at length, in virtual time.
//   in     --hours of link for budgets and ages (1 is the whole), --seed, --json FILE
//   out    a table with gate and figure; the same as JSON
//   errors exit 1 where a gate is missed, 2 for wrong usage
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace pitwall::benchmarks {

int radio_gates(std::span<const std::string> args);

}  // namespace pitwall::benchmarks
