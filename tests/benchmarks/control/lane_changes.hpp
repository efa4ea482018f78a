// Lane changes of the control benchmark: at 57, 62 and 66 m/s the car is given the lane beside its
// own every eight seconds, and goes there by the merge of its planner.
//   in     a scenario of flying laps, the set-up of the car; the lanes are lines at an offset to
//          either side of its own
//   out    true distance to the planned path while the car changes; changes; why a run ended early
//   errors Problem of the run; no room for the lanes
//   units  m, m/s
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "hil/grading/cross_track.hpp"
#include "protocol/vocabulary/result.hpp"
#include "tests/benchmarks/control/control_plan.hpp"
#include "tests/benchmarks/control/control_table.hpp"
#include "vehicle/pipeline/setup.hpp"

namespace pitwall::control_bench {

struct LaneChangeRow {
  std::string track, world, law;
  grading::ErrorStatistics error;
  std::size_t changes = 0;
  bool is_judged = true;
  std::string end;  // where and why, if it ended early; else empty
};

Plan lane_change_plan(const scenario::Scenario& like);
Result<LaneChangeRow, Problem> run_lane_changes(const Plan& plan, const pipeline::Setup& setup);

// Of our law alone: it ends no run early; in the nominal world its mean is at most 0.25 m and its
// maximum 0.60 m, in another that is judged its mean is at most 0.40 m. Source as in
// control_table.hpp.
std::vector<Gate> gates_of(const std::vector<LaneChangeRow>& rows);
std::string to_text(const std::vector<LaneChangeRow>& rows);
std::string to_json(const std::vector<LaneChangeRow>& rows);  // an array

}  // namespace pitwall::control_bench
