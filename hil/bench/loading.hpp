// Loader of a scenario and its car: the one place where the bench opens its input files.
//   errors Problem with file:line:column; nothing is started
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "hil/bench/field.hpp"
#include "hil/scenario/scenario.hpp"
#include "protocol/vocabulary/result.hpp"
#include "vehicle/pipeline/setup.hpp"

namespace pitwall::bench {

// Another car with a full stack: the flags, track and duration of the run, a start of its own.
struct LoadedStack {
  std::string name;
  int number = 0;
  scenario::Scenario scenario;
  pipeline::Setup setup;
};

struct Loaded {
  scenario::Scenario scenario;
  pipeline::Setup setup;
  std::vector<FieldGhost> ghosts{};  // the other cars of the scenario
  std::vector<LoadedStack> stacks{};
};

// The path of what is named relative to `folder` unless it is absolute.
std::string below(const std::string& folder, const std::string& path);

// Track, car and plant files are named relative to `folder` unless they are absolute.
Result<Loaded, Problem> load(const std::string& scenario_file, const std::string& folder);
// Of a scenario that is no file; `name`: for messages.
Result<Loaded, Problem> load_text(const std::string& text, const std::string& name,
                                  const std::string& folder);

}  // namespace pitwall::bench
