// What was promised of the radio and what was measured, as a table and as JSON.
//   in     gates as they are measured
//   out    text; whether all held
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace pitwall::radio {

struct Gate {
  std::string what, unit;
  double figure = 0.0, limit = 0.0;  // held: figure <= limit

  bool held() const { return figure <= limit; }
};

std::string line_of(const Gate& gate);
std::string json_of(const std::vector<Gate>& gates);
bool all_held(const std::vector<Gate>& gates);

}  // namespace pitwall::radio
