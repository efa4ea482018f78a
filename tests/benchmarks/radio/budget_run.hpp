// Check of the radio budget on every datagram that leaves either end: the budget must hold in every
// window, under any offered load.
//   in     rate, offered load, disturbance of the radio, length
//   out    the worst windows of each path and direction, and the limits of path_budget.hpp
//   invariants
//          only departures count, over every closed window that begins with one
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tests/benchmarks/radio/stress_load.hpp"
#include "tests/benchmarks/radio/virtual_radio.hpp"

namespace pitwall::radio {

struct WorstWindow {
  std::uint64_t bytes = 0, packets = 0;
};
WorstWindow worst_window(const std::vector<Departure>& departures, Duration length);

struct BudgetVerdict {
  std::string what;
  std::uint64_t packets = 0;
  WorstWindow tenth, second;  // of 100 ms, of 1 s
  double tenth_bytes_max = 0.0, tenth_packets_max = 0.0, second_bytes_max = 0.0;

  bool holds() const;
};
BudgetVerdict judge(const std::vector<Departure>& departures, const telemetry::BudgetParams& params,
                    std::string what);
std::string to_string(const BudgetVerdict& verdict);

struct BudgetCell {
  double kbit_per_s = 256.0, load = 0.0;
  Trouble trouble = Trouble::kNone;
  Duration length = seconds(20);
  double loss = 0.1;
  std::uint8_t paths = 1;
  std::uint64_t seed = 1;
};
struct BudgetRun {
  std::vector<BudgetVerdict> verdicts;
  std::uint64_t arrivals = 0, applied = 0, openings = 0;
  bool established = false;
};
BudgetRun run_budget(const BudgetCell& cell);

}  // namespace pitwall::radio
