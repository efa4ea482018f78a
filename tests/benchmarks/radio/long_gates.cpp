// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/radio/long_gates.hpp"

#include <string>
#include <vector>

#include "tests/benchmarks/radio/budget_run.hpp"
#include "tests/benchmarks/radio/burst_run.hpp"

namespace pitwall::radio {

namespace {

constexpr Duration kBudgetWhole = seconds(3'600), kBurstWhole = seconds(1'800);

bool tell(const PrintLine& print, const std::string& line, bool holds) {
  print((holds ? "holds   " : "BROKEN  ") + line);
  return holds;
}

std::vector<BudgetCell> cells() {
  std::vector<BudgetCell> cells;
  for (const double kbit_per_s : {64.0, 128.0, 256.0, 1'024.0}) {
    for (const double load : {0.0, 1.0, 3.0, 20.0}) {
      cells.push_back({.kbit_per_s = kbit_per_s, .load = load});
    }
    for (const Trouble trouble : {Trouble::kCommands, Trouble::kOpenings, Trouble::kRestarts}) {
      cells.push_back({.kbit_per_s = kbit_per_s, .load = 3.0, .trouble = trouble});
    }
  }
  return cells;
}

}  // namespace

bool run_long_gates(const PrintLine& print, double share) {
  bool all = true;
  std::vector<BudgetCell> budget = cells();
  for (BudgetCell& cell : budget) {
    cell.length = from_seconds(kBudgetWhole.seconds() * share / static_cast<double>(budget.size()));
    for (const BudgetVerdict& v : run_budget(cell).verdicts) {
      all = tell(print, to_string(v), v.holds()) && all;
    }
  }
  // Keys change each 15 minutes.
  const BudgetCell rekey{.load = 1.0, .length = from_seconds(kBurstWhole.seconds() * share)};
  for (const BudgetVerdict& v : run_budget(rekey).verdicts) {
    all = tell(print, to_string(v) + " (key phases)", v.holds()) && all;
  }
  for (const std::uint8_t paths : {std::uint8_t{1}, std::uint8_t{2}}) {
    for (const double load : {0.0, 3.0}) {
      for (const std::uint64_t seed : {1U, 2U, 3U}) {
        const BurstCase c{.paths = paths,
                          .load = load,
                          .seed = seed,
                          .length = from_seconds(kBurstWhole.seconds() * share)};
        const BurstRun run = run_burst(c);
        all = tell(print, to_string(c, run), run.holds()) && all;
      }
    }
  }
  return all;
}

}  // namespace pitwall::radio
