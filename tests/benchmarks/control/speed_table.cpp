// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/control/speed_table.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "protocol/json/json_text.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::speed_bench {
namespace {

// The figure of each of our rows is at most its bound.
Gate gate_of(const std::string& name, const std::vector<SpeedRow>& rows,
             const std::function<double(const SpeedRow&)>& excess,
             const std::function<std::string(const SpeedRow&)>& figure) {
  Gate gate{name, "", false};
  double worst = -HUGE_VAL;
  for (const SpeedRow& r : rows) {
    if (r.law != control_bench::kOurs) continue;
    const double e = std::isnan(excess(r)) ? HUGE_VAL : excess(r);
    if (e <= worst) continue;
    worst = e;
    gate.worst = figure(r) + ": " + r.track + ' ' + r.world;
  }
  gate.held = worst <= 0.0 && worst > -HUGE_VAL;
  return gate;
}

double count(std::size_t n) { return static_cast<double>(n); }

std::string row_text(const SpeedRow& r) {
  return formatted("%-6.6s %-14.14s %-13s %7.3f %7.3f %8.3f %7.3f %9.3f %5zu/%zu %6zu/%zu %6zu ",
                   r.track.c_str(), r.world.c_str(), r.law.c_str(), r.steady.rms_mps(),
                   r.steady.max_mps, r.driving.rms_mps(), r.driving.max_mps, r.overshoot_mps,
                   r.brakings, r.slow_downs, r.shifts, r.crossings, r.missed_shifts) +
         r.end + '\n';
}

std::string row_json(const SpeedRow& r) {
  return json::Object{}
      .text("track", r.track)
      .text("world", r.world)
      .text("law", r.law)
      .text("end", r.end)
      .number("steady_rms_mps", r.steady.rms_mps())
      .number("steady_max_mps", r.steady.max_mps)
      .number("driving_rms_mps", r.driving.rms_mps())
      .number("driving_max_mps", r.driving.max_mps)
      .number("overshoot_mps", r.overshoot_mps)
      .number("brakings", count(r.brakings))
      .number("steady_brakings", count(r.steady_brakings))
      .number("shifts", count(r.shifts))
      .number("crossings", count(r.crossings))
      .number("missed_shifts", count(r.missed_shifts))
      .str();
}

}  // namespace

std::vector<Gate> gates_of(const std::vector<SpeedRow>& rows) {
  return {
      gate_of(
          "speed error at a held speed", rows,
          [](const SpeedRow& r) { return r.steady.rms_mps() - kSteadyRms_mps; },
          [](const SpeedRow& r) {
            return formatted("%.3f of %.1f m/s rms", r.steady.rms_mps(), kSteadyRms_mps);
          }),
      gate_of(
          "overshoot of the step from 30 to 40 m/s", rows,
          [](const SpeedRow& r) { return r.overshoot_mps - kOvershoot_mps; },
          [](const SpeedRow& r) {
            return formatted("%.3f of %.1f m/s", r.overshoot_mps, kOvershoot_mps);
          }),
      gate_of(
          "no braking at a held speed, once for each lower speed", rows,
          [](const SpeedRow& r) {
            return count(r.brakings) - count(r.slow_downs) + 100.0 * count(r.steady_brakings);
          },
          [](const SpeedRow& r) {
            return formatted("%zu for %zu, %zu at a held speed", r.brakings, r.slow_downs,
                             r.steady_brakings);
          }),
      gate_of(
          "as many shifts as the profile crosses, none missed", rows,
          [](const SpeedRow& r) {
            return count(r.shifts) - count(r.crossings) + 100.0 * count(r.missed_shifts);
          },
          [](const SpeedRow& r) {
            return formatted("%zu for %zu, %zu missed", r.shifts, r.crossings, r.missed_shifts);
          }),
      gate_of(
          "nothing refused, every run ends as planned", rows,
          [](const SpeedRow& r) { return count(r.refusals) + (r.end.empty() ? 0.0 : 1.0); },
          [](const SpeedRow& r) { return formatted("%zu refused %s", r.refusals, r.end.c_str()); }),
  };
}

bool all_held(const std::vector<SpeedRow>& rows) {
  return std::ranges::all_of(gates_of(rows), &Gate::held);
}

std::string to_text(const std::vector<SpeedRow>& rows) {
  std::string out =
      "SIMULATION, lockstep, estimator in the loop. True speed against the governed reference, "
      "m/s.\n" +
      formatted("%-6s %-14s %-13s %7s %7s %8s %7s %9s %7s %8s %6s\n", "track", "car", "law",
                "steady", "max", "driving", "max", "overshoot", "brakes", "shifts", "missed");
  for (const SpeedRow& row : rows) out += row_text(row);
  for (const Gate& gate : gates_of(rows))
    out += formatted("gate: %s: %s; worst %s\n", gate.name.c_str(), gate.held ? "held" : "MISSED",
                     gate.worst.c_str());
  return out;
}

std::string to_json(const std::vector<SpeedRow>& rows) {
  json::Array listed, gates;
  for (const SpeedRow& row : rows) listed.json(row_json(row));
  for (const Gate& gate : gates_of(rows))
    gates.json(json::Object{}
                   .text("name", gate.name)
                   .flag("held", gate.held)
                   .text("worst", gate.worst)
                   .str());
  return json::Object{}
             .text("bench", "speed")
             .flag("simulation", true)
             .json("rows", listed.str())
             .json("gates", gates.str())
             .flag("held", all_held(rows))
             .str() +
         "\n";
}

}  // namespace pitwall::speed_bench
