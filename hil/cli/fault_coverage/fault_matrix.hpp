// Fault coverage matrix: for each fault the monitor that detects it, the delay, and where the car
// ends. The fault scenarios run one by one.
//   in     loaded scenarios, named "f01_...", each with at least one `detects`
//   out    rows, uncovered faults, a table, JSON
//   invariants
//          a row fails if an expectation of its scenario fails, if the car ends in a wall, or if
//          nothing is detected. A fault of the catalogue without a passed scenario is uncovered,
//          which is a failure too
//   errors Problem of a scenario
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hil/bench/loading.hpp"
#include "hil/cli/fault_coverage/proof.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"
#include "vehicle/world/monitor.hpp"

namespace pitwall::fault_coverage {

struct Detection {
  std::string by;  // name of a monitor, or a condition
  std::optional<Duration> delay;
  Duration deadline{};
  bool passed = false;
  std::string reason;  // why it failed
};

struct FaultRow {
  std::string id;  // "F01"
  std::string scenario;
  std::vector<Detection> detections;
  std::string outcome;              // where the car ended, as text
  std::vector<std::string> failed;  // other expectations that failed
  double simulated_s = 0.0;

  bool passed() const;
};

// Catalogue id of a scenario by its name, "F01"; "-" if it is not in the catalogue.
std::string id_of(const std::string& scenario);

// The monitors in `off` are switched off.
Result<FaultRow, Problem> run_fault(const bench::Loaded& loaded, world::MonitorSet off);

// Ids of the catalogue without a passed row, in catalogue order.
std::vector<std::string> holes(const std::vector<FaultRow>& rows);

std::string to_text(const std::vector<FaultRow>& rows);
std::string to_json(const std::vector<FaultRow>& rows, const std::vector<Proof>& proofs);

}  // namespace pitwall::fault_coverage
