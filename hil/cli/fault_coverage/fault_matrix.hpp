// Fault coverage: which monitor notices a fault, how fast, and where the car ends: the scenarios of
// faults run one by one, and the matrix of what came out.
//   in     loaded scenarios, named "f01_...", each with at least one `detects`
//   out    rows, holes, a table, JSON
//   invariants
//          a row fails if an expectation of its scenario does, if the car ends in a wall, or if it
//          detects nothing. A fault of the catalogue without a scenario is a hole, which
//          is a failure too
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
  std::string by;  // a monitor's name, or a condition
  std::optional<Duration> delay;
  Duration deadline{};
  bool passed = false;
  std::string reason;  // why not
};

struct FaultRow {
  std::string id;  // "F01"
  std::string scenario;
  std::vector<Detection> detections;
  std::string outcome;              // where the car ended, in words
  std::vector<std::string> failed;  // other expectations, and what else is wrong
  double simulated_s = 0.0;

  bool passed() const;
};

// Of a scenario by its name, "F01"; "-" where it is not of the catalogue.
std::string id_of(const std::string& scenario);

// The monitors in `off` see nothing.
Result<FaultRow, Problem> run_fault(const bench::Loaded& loaded, world::MonitorSet off);

// Ids of the catalogue for which there is no row that passed, in its order.
std::vector<std::string> holes(const std::vector<FaultRow>& rows);

std::string to_text(const std::vector<FaultRow>& rows);
std::string to_json(const std::vector<FaultRow>& rows, const std::vector<Proof>& proofs);

}  // namespace pitwall::fault_coverage
