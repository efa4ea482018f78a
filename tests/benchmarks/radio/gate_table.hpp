// Gates of the radio, limit and measured figure, as a table and as JSON.
//   in     gates in the order of measurement
//   out    text; whether all hold
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
