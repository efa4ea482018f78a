// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/radio/budget_run.hpp"

#include <array>
#include <cstdio>
#include <utility>

#include "protocol/telemetry/packet/header.hpp"
#include "tests/benchmarks/radio/offered_load.hpp"
#include "tests/benchmarks/radio/rate_window.hpp"

namespace pitwall::radio {

namespace {

constexpr Duration kWay = milliseconds(15);

std::string name_of(const BudgetCell& cell, bool down) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.0f kbit/s %.0fx %s %s", cell.kbit_per_s, cell.load,
                text_of(cell.trouble), down ? "down" : "up");
  return text.data();
}

RadioSetup setup_of(const BudgetCell& cell) {
  const double rate = cell.kbit_per_s * 125.0;
  link::LinkParams link = link::bursty(0.0, {}, rate, kWay);
  link.loss = cell.loss;
  RadioSetup setup;
  setup.down.fill(link);
  setup.up.fill(link);
  for (auto* budgets : {&setup.budget_down, &setup.budget_up}) {
    for (auto& budget : *budgets) budget.bytes_per_s = rate;
  }
  setup.paths = cell.paths;
  setup.seed = cell.seed;
  return setup;
}

}  // namespace

// Closed at both ends: a nanosecond longer than what RateWindow counts.
WorstWindow worst_window(const std::vector<Departure>& departures, Duration length) {
  link::RateWindow window(length + nanoseconds(1));
  for (const Departure& d : departures) window.sent(d.bytes, d.at);
  return {window.worst_bytes(), window.worst_packets()};
}

bool BudgetVerdict::holds() const {
  return static_cast<double>(tenth.bytes) <= tenth_bytes_max &&
         static_cast<double>(tenth.packets) <= tenth_packets_max &&
         static_cast<double>(second.bytes) <= second_bytes_max;
}

BudgetVerdict judge(const std::vector<Departure>& departures, const telemetry::BudgetParams& params,
                    std::string what) {
  const auto budget = telemetry::PathBudget::make(params);
  const auto largest =
      static_cast<double>(budget.value().largest_payload() + telemetry::kIpUdpOverhead);
  return {.what = std::move(what),
          .packets = departures.size(),
          .tenth = worst_window(departures, milliseconds(100)),
          .second = worst_window(departures, seconds(1)),
          .tenth_bytes_max = params.bytes_per_s * 0.1 + largest,
          .tenth_packets_max = params.packets_per_s * 0.1 + 1.0,
          .second_bytes_max = params.bytes_per_s};
}

std::string to_string(const BudgetVerdict& v) {
  std::array<char, 200> text{};
  std::snprintf(text.data(), text.size(),
                "%-32s %8llu packets; worst 100 ms %5.1f %% of what may be, %2llu packets; worst "
                "1 s %5.1f %%",
                v.what.c_str(), static_cast<unsigned long long>(v.packets),
                100.0 * static_cast<double>(v.tenth.bytes) / v.tenth_bytes_max,
                static_cast<unsigned long long>(v.tenth.packets),
                100.0 * static_cast<double>(v.second.bytes) / v.second_bytes_max);
  return text.data();
}

BudgetRun run_budget(const BudgetCell& cell) {
  const RadioSetup setup = setup_of(cell);
  VirtualRadio radio(setup);
  radio.record_departures(true);
  OfferedLoad load(setup.budget_down[0].bytes_per_s, cell.load);
  StressLoad stress(radio, cell.trouble);
  for (const Instant end = radio.now() + cell.length; radio.now() < end;) {
    stress.step();
    load.run(radio, kStep);
  }
  BudgetRun run;
  for (telemetry::PathId path = 0; path < cell.paths; ++path) {
    run.verdicts.push_back(
        judge(radio.departures(true, path), setup.budget_down[path], name_of(cell, true)));
    run.verdicts.push_back(
        judge(radio.departures(false, path), setup.budget_up[path], name_of(cell, false)));
  }
  run.arrivals = radio.arrivals();
  run.applied = stress.applied();
  run.openings = stress.openings();
  run.established = radio.car_report().established;
  return run;
}

}  // namespace pitwall::radio
