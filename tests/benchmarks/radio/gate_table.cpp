// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/radio/gate_table.hpp"

#include <algorithm>

#include "protocol/json/json_text.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::radio {

std::string line_of(const Gate& gate) {
  return formatted("  %-6s %-58s %10.2f <= %10.2f %s", gate.held() ? "held" : "MISSED",
                   gate.what.c_str(), gate.figure, gate.limit, gate.unit.c_str());
}

std::string json_of(const std::vector<Gate>& gates) {
  json::Array rows;
  for (const Gate& gate : gates)
    rows.json(json::Object{}
                  .text("what", gate.what)
                  .number("figure", gate.figure)
                  .number("limit", gate.limit)
                  .text("unit", gate.unit)
                  .flag("held", gate.held())
                  .str());
  return json::Object{}.json("gates", rows.str()).str() + "\n";
}

bool all_held(const std::vector<Gate>& gates) {
  return std::all_of(gates.begin(), gates.end(), [](const Gate& gate) { return gate.held(); });
}

}  // namespace pitwall::radio
