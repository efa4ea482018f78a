// Plan of a sweep: a scenario, and which of its values differ from case to case. Strict YAML:
//
//   schema: 1
//   name: grip_and_wind
//   scenario: hil/scenarios/grip_low.yaml   # relative to where the sweep is started
//   seed: 1
//   combine: draw       # draw: `cases` of them at random; all: every combination; pairs: so few
//   cases: 200          #   that every two values of two parameters meet
//   parameters:
//     - {path: perturb.friction, from: 0.7, to: 1.1}      # drawn evenly; `draw` alone
//     - {path: "faults[0].value", values: [0.6, 0.8]}     # one of these
//
//   seeds  each case has its own, of the plan's seed and its number, unless a parameter is "seed";
//          `repeats` (all, pairs) runs each combination with so many
//   errors Problem with file:line:column, and the number of cases where they are too many
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::sweep {

inline constexpr std::size_t kCasesMost = 1'000'000, kParametersMost = 32, kValuesMost = 1'000;

enum class Combine : std::uint8_t { kDraw, kAll, kPairs };

// A path into the scenario (protocol/yaml/edited.hpp) and what may stand there.
struct Parameter {
  std::string path;
  std::vector<std::string> values{};  // empty: any from `from` to `to`
  double from = kUnset, to = kUnset;
};

struct Plan {
  std::string name, scenario_file;
  std::uint64_t seed = 0;
  Combine combine = Combine::kDraw;
  std::size_t cases = 0;    // of kDraw
  std::size_t repeats = 1;  // of the others, of each combination
  std::vector<Parameter> parameters{};
};

Result<Plan, Problem> read_plan(const std::string& text, const std::string& name);

}  // namespace pitwall::sweep
