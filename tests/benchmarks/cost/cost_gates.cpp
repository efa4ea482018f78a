// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/cost/cost_gates.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

#include "protocol/json/json_text.hpp"

namespace pitwall::cost {

double CostGate::units() const {
  const bool is_measured = std::isfinite(cost_us) && cost_us > 0.0 && unit_us > 0.0;
  return is_measured ? cost_us / unit_us : std::numeric_limits<double>::infinity();
}

void CostGates::at_most(CostGate gate) {
  const bool held = gate.held();
  rows_.push_back({.cost = std::move(gate), .is_cost = true, .held = held});
}

void CostGates::count(std::string what, bool held) {
  rows_.push_back({.cost = {.what = std::move(what)}, .is_cost = false, .held = held});
}

bool CostGates::held() const {
  return !rows_.empty() &&
         std::all_of(rows_.begin(), rows_.end(), [](const Row& row) { return row.held; });
}

std::string CostGates::text() const {
  std::string lines;
  for (const Row& row : rows_) {
    lines += "gate: " + row.cost.what;
    if (row.is_cost) {
      char costs[160];
      std::snprintf(costs, sizeof costs,
                    ": %.3f reference units, at most %.3f (%g us on the reference machine)",
                    row.cost.units(), limit_units(row.cost.limit_us), row.cost.limit_us);
      lines += costs;
    }
    lines += row.held ? ": held\n" : ": MISSED\n";
  }
  return lines;
}

std::string CostGates::json() const {
  json::Array rows;
  for (const Row& row : rows_) {
    json::Object object;
    object.text("gate", row.cost.what);
    if (row.is_cost)
      object.number("units", row.cost.units())
          .number("limit_units", limit_units(row.cost.limit_us))
          .number("cost_us", row.cost.cost_us)
          .number("unit_us", row.cost.unit_us);
    rows.json(object.flag("held", row.held).str());
  }
  return rows.str();
}

}  // namespace pitwall::cost
