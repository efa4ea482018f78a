// Table and file of detectors' scores.
//   out    recall, errors and false detections by distance; the same as a file for the simulator of
//          detections
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "tests/benchmarks/cost/cost_gates.hpp"
#include "tests/benchmarks/perception/detection_run.hpp"

namespace pitwall::perception_bench {

// What the network has to reach on scenes unlike those of its training: of the cars with
// kReturnsLeast returns 0.98 found to 60 m, 0.95 to 100 m; 0.01 false ones a sweep; 0.15 m rms to
// 60 m, 0.30 m from there to 100 m.
void add_gates(const DetectionScore& held_back, cost::CostGates& gates);
// Among decoys that it has not seen before: 0.02 false ones a sweep.
void add_decoy_gate(const DetectionScore& among_decoys, cost::CostGates& gates);

std::string to_text(std::span<const DetectorRow> rows);
// As hil/scenario/lidar_error_file.hpp reads it; distances without a car are left out.
std::string error_file(const DetectorRow& row);
std::string to_json(std::span<const DetectorRow> rows);  // array; unset figures are null

}  // namespace pitwall::perception_bench
