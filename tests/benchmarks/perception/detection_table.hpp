// Table and file of detectors' scores.
//   out    recall, errors and false detections by distance; for a simulator of detections the same
//          as a file
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "tests/benchmarks/perception/detection_run.hpp"

namespace pitwall::perception_bench {

std::string to_text(std::span<const DetectorRow> rows);
std::string to_json(std::span<const DetectorRow> rows);  // array; unset figures are null

}  // namespace pitwall::perception_bench
