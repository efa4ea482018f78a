// The option --clock of the programs on the car: the wall clock, or the time of a bench.
//   invariants
//          only a simulation goes by the time of a bench: a car would stop seeing what passes
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
