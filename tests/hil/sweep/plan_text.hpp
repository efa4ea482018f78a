// Plans of sweeps as text, for tests.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace pitwall::sweep {

inline std::string drawn_plan() {
  return R"(schema: 1
name: some
scenario: hil/scenarios/grip_low.yaml
seed: 3
combine: draw
cases: 40
parameters:
  - {path: perturb.friction, from: 0.5, to: 1.5}
  - {path: perturb.wind_mps, values: [0, 8]}
)";
}

// Parameters a, b, ... with so many values each: a0, a1, ...
inline std::string listed_plan(const std::string& combine, const std::vector<int>& counts) {
  std::string text =
      "schema: 1\nname: some\nscenario: s.yaml\nseed: 3\ncombine: " + combine + "\nparameters:\n";
  char name = 'a';
  for (const int count : counts) {
    text += std::string("  - {path: ") + name + ", values: [";
    for (int k = 0; k < count; ++k) text += (k == 0 ? "" : ", ") + (name + std::to_string(k));
    text += "]}\n";
    ++name;
  }
  return text;
}

inline std::string spoilt(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  if (at != std::string::npos) text.replace(at, from.size(), to);
  return text;
}

}  // namespace pitwall::sweep
