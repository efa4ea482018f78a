// Command-line option --clock of the programs on the car: the wall clock, or the time of a bench.
//   invariants
//          the time of a bench is allowed with --simulation only: on a real car it may differ from
//          real time
//   errors CLI::ValidationError
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace pitwall::io {

void add_clock(CLI::App& app, std::string& clock);
void check_clock(const std::string& clock, bool simulation);

}  // namespace pitwall::io
