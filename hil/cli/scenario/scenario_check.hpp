// Check of a scenario before anything is run: the file, the files that it names, the signals of its
// expectations, its faults by the catalogue, the texts of its operator.
//   out    nullopt: `run` would begin it, in lockstep or live
//   errors Problem with file:line:column where it has one
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "protocol/vocabulary/result.hpp"

namespace pitwall::cli {

std::optional<Problem> problem_in(const std::string& scenario_file);
// Of a scenario that is no file yet; `name`: for messages.
std::optional<Problem> problem_in_text(const std::string& text, const std::string& name);

}  // namespace pitwall::cli
