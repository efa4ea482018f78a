// Table of scenarios: file, name, duration, track, car, numbers of faults and expectations, each as
// the scenario has it; track and car without folder and ending.
//   in     rows without a problem
//   out    lines of text, the first with the names of the columns
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "hil/cli/bench_server/catalogue.hpp"

namespace pitwall::cli {

std::string scenario_table(std::span<const bench_server::Listed> rows);

}  // namespace pitwall::cli
