// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/time_trial/trial_table.hpp"

#include <algorithm>
#include <cmath>

#include "protocol/json/json_text.hpp"
#include "protocol/vocabulary/text.hpp"
#include "tests/benchmarks/time_trial/trial_plan.hpp"

namespace pitwall::time_trial {
namespace {

// The runs of a change, by its name.
enum class Kind { kOwnFriction, kCarefulCar, kSlipperyPlant };

Kind kind_of(const TrialRow& row) {
  for (const Change& change : changes()) {
    if (change.name != row.name) continue;
    if (change.friction < 1.0) return Kind::kSlipperyPlant;
    if (change.planned_friction) return Kind::kCarefulCar;
  }
  return Kind::kOwnFriction;
}

const char* end_of(const TrialRow& row) {
  if (row.contact) return "TOUCHED A WALL";
  if (row.spun()) return "SPUN";
  if (row.stopped) return "stopped by its supervisor";
  return row.laps == kLaps ? "" : "UNFINISHED";
}

std::string line_of(const TrialRow& r) {
  return formatted("%-22s %4llu %4u %7.2f %7.2f %7.3f %7.3f %7.3f %6.2f %6.2f %6.2f %6.2f  %s\n",
                   r.name.c_str(), static_cast<unsigned long long>(r.seed), r.laps, r.mean_mps,
                   to_mph(r.mean_mps), r.best_s, r.worst_s, r.planned_s, r.speed_max_mps,
                   r.slip_max_deg, r.cross_track_max_m, r.wall_gap_m, end_of(r));
}

std::string json_of(const TrialRow& r) {
  return json::Object{}
      .text("name", r.name)
      .number("seed", static_cast<double>(r.seed))
      .number("laps", r.laps)
      .number("mean_mps", r.mean_mps)
      .number("best_lap_s", r.best_s)
      .number("worst_lap_s", r.worst_s)
      .number("planned_lap_s", r.planned_s)
      .number("speed_max_mps", r.speed_max_mps)
      .number("side_slip_max_deg", r.slip_max_deg)
      .number("cross_track_max_m", r.cross_track_max_m)
      .number("wall_gap_least_m", r.wall_gap_m)
      .flag("clean", r.is_clean())
      .str();
}

std::string gate(const char* what, bool held) {
  return formatted("gate: %s: %s\n", what, held ? "held" : "MISSED");
}

}  // namespace

Gates gates_of(const std::vector<TrialRow>& rows) {
  Gates gates;
  double slowest_mps = HUGE_VAL;
  for (const TrialRow& row : rows)
    if (kind_of(row) == Kind::kOwnFriction) slowest_mps = std::fmin(slowest_mps, row.mean_mps);
  gates.fast = !rows.empty() && to_mph(slowest_mps) >= kMeanLeast_mph;
  for (const TrialRow& row : rows) {
    const Kind kind = kind_of(row);
    if (kind != Kind::kSlipperyPlant && !row.is_clean()) gates.clean = false;
    if (kind == Kind::kOwnFriction && !(to_mph(row.mean_mps) >= kMeanLeast_mph)) gates.fast = false;
    if (kind == Kind::kCarefulCar && !(row.mean_mps < slowest_mps)) gates.careful = false;
  }
  return gates;
}

std::string to_text(const std::vector<TrialRow>& rows) {
  std::string out = formatted(
      "SIMULATION, lockstep. Mean of %u consecutive laps, m/s and mph; laps in s: best, worst, and "
      "that of\nthe plan on warm tyres; peak speed, m/s; side slip, degrees; from the line and "
      "least to a wall, m.\n%-22s seed laps    mean     mph    best   worst    plan   peak   slip  "
      " line   wall\n",
      kLaps, "run");
  for (const TrialRow& row : rows) out += line_of(row);
  const Gates gates = gates_of(rows);
  return out + gate("every lap without a spin, a contact or a stop", gates.clean) +
         gate(formatted("every mean is at least %.1f mph", kMeanLeast_mph).c_str(), gates.fast) +
         gate("slower with little friction in the car's file", gates.careful);
}

std::string to_json(const std::vector<TrialRow>& rows) {
  std::string runs;
  for (const TrialRow& row : rows) runs += (runs.empty() ? "" : ",\n") + json_of(row);
  const Gates gates = gates_of(rows);
  return json::Object{}
             .json("runs", "[" + runs + "]")
             .flag("clean", gates.clean)
             .flag("fast", gates.fast)
             .flag("careful", gates.careful)
             .str() +
         "\n";
}

}  // namespace pitwall::time_trial
