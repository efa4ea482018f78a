// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/radio/gate_table.hpp"

#include <algorithm>
#include <cstdio>

namespace pitwall::radio {

std::string line_of(const Gate& gate) {
  char line[160];
  std::snprintf(line, sizeof line, "  %-6s %-58s %10.2f <= %10.2f %s",
                gate.held() ? "held" : "MISSED", gate.what.c_str(), gate.figure, gate.limit,
                gate.unit.c_str());
  return line;
}

std::string json_of(const std::vector<Gate>& gates) {
  std::string json = "{\"gates\": [";
  for (const Gate& gate : gates) {
    char row[320];
    std::snprintf(row, sizeof row,
                  "%s\n  {\"what\": \"%s\", \"figure\": %.9g, \"limit\": %.9g, \"unit\": \"%s\", "
                  "\"held\": %s}",
                  &gate == gates.data() ? "" : ",", gate.what.c_str(), gate.figure, gate.limit,
                  gate.unit.c_str(), gate.held() ? "true" : "false");
    json += row;
  }
  return json + "\n]}\n";
}

bool all_held(const std::vector<Gate>& gates) {
  return std::all_of(gates.begin(), gates.end(), [](const Gate& gate) { return gate.held(); });
}

}  // namespace pitwall::radio
