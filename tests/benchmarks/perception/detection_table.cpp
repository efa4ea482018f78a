// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/perception/detection_table.hpp"

#include <cmath>
#include <numbers>

#include "protocol/json/json_text.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::perception_bench {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

// A figure of no car is none.
double known(double value, std::size_t count) { return count > 0 ? value : kUnset; }

std::string column(double value, int digits) {
  return std::isfinite(value) ? formatted(" %8.*f", digits, value) : formatted(" %8s", "-");
}

std::string row_text(const DetectorRow& row) {
  std::string text = formatted("%s, %s: %zu sweeps, %.3f false cars a sweep\n", row.set.c_str(),
                               row.detector.c_str(), row.score.sweeps, row.score.false_per_sweep());
  for (std::size_t k = 0; k < kRanges; ++k) {
    const RangeScore& range = row.score.by_range[k];
    text += formatted("  %3.0f to %3.0f m %6zu", kRanges_m[k], kRanges_m[k + 1], range.cars) +
            column(known(range.found_share(), range.cars), 3) +
            column(known(range.position_rms_m(), range.found), 3) +
            column(known(range.worst_m, range.found), 3) +
            column(kDegrees * known(range.yaw_rms_rad(), range.found), 1) + "\n";
  }
  return text;
}

}  // namespace

void add_gates(const DetectionScore& held_back, cost::CostGates& gates) {
  const RangeScore near = held_back.between(0.0, 60.0), far = held_back.between(60.0, 100.0);
  const RangeScore all = held_back.between(0.0, 100.0);
  const auto add = [&](const char* what, double value, double limit, bool held) {
    gates.count(formatted("network: %s: %.3f of %.3f", what, value, limit), held);
  };
  add("found to 60 m", near.found_share(), 0.98, near.found_share() >= 0.98);
  add("found to 100 m", all.found_share(), 0.95, all.found_share() >= 0.95);
  add("false cars a sweep", held_back.false_per_sweep(), 0.01, held_back.false_per_sweep() <= 0.01);
  add("rms to 60 m", near.position_rms_m(), 0.15, near.position_rms_m() <= 0.15);
  add("rms from 60 to 100 m", far.position_rms_m(), 0.30, far.position_rms_m() <= 0.30);
}

void add_decoy_gate(const DetectionScore& among_decoys, cost::CostGates& gates) {
  const double share = among_decoys.false_per_sweep();
  gates.count(formatted("network: false cars a sweep among decoys: %.3f of 0.020", share),
              share <= 0.02);
}

std::string to_text(std::span<const DetectorRow> rows) {
  std::string text = formatted("%-15s %6s %8s %8s %8s %8s\n", "simulation", "cars", "recall",
                               "rms m", "worst m", "yaw deg");
  for (const DetectorRow& row : rows) text += row_text(row);
  return text;
}

std::string error_file(const DetectorRow& row) {
  std::string text = formatted(
      "# Measured in simulation by `./pitwall bench perception --errors`: %zu sweeps, %s.\n"
      "detector: %s\nfalse_per_sweep: %.4f\nranges:\n",
      row.score.sweeps, row.set.c_str(), row.detector.c_str(), row.score.false_per_sweep());
  for (std::size_t k = 0; k < kRanges; ++k) {
    const RangeScore& range = row.score.by_range[k];
    if (range.found == 0) continue;
    text += formatted(
        "  - {from_m: %.0f, to_m: %.0f, found: %.4f, position_rms_m: %.4f, yaw_rms_deg: %.3f}\n",
        kRanges_m[k], kRanges_m[k + 1], range.found_share(), range.position_rms_m(),
        kDegrees * range.yaw_rms_rad());
  }
  return text;
}

std::string to_json(std::span<const DetectorRow> rows) {
  json::Array array;
  for (const DetectorRow& row : rows) {
    json::Array ranges;
    for (std::size_t k = 0; k < kRanges; ++k) {
      const RangeScore& range = row.score.by_range[k];
      ranges.json(json::Object{}
                      .number("from_m", kRanges_m[k])
                      .number("to_m", kRanges_m[k + 1])
                      .number("cars", range.cars)
                      .number("recall", known(range.found_share(), range.cars))
                      .number("position_rms_m", known(range.position_rms_m(), range.found))
                      .number("yaw_rms_rad", known(range.yaw_rms_rad(), range.found))
                      .str());
    }
    array.json(json::Object{}
                   .text("set", row.set)
                   .text("detector", row.detector)
                   .number("sweeps", row.score.sweeps)
                   .number("false_per_sweep", row.score.false_per_sweep())
                   .json("ranges", ranges.str())
                   .str());
  }
  return array.str();
}

}  // namespace pitwall::perception_bench
