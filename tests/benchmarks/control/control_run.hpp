// Run of one control law in one world: true cross-track error in each window of the plan.
//   in     scenario and windows of control_plan.hpp, the car with its control law
//   out    ControlRow; a contact or a stop by the car itself ends the figures
//   invariants
//          a tick counts if the true speed is within its bracket; the estimator is in the loop, the
//          error is measured from the true position
//   units  m, m/s
//   errors Problem of the scenario; a bad run is not an error but a row
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "hil/bench/rig.hpp"
#include "hil/grading/cross_track.hpp"
#include "protocol/vocabulary/result.hpp"
#include "tests/benchmarks/control/control_plan.hpp"
#include "vehicle/pipeline/step.hpp"

namespace pitwall::control_bench {

struct ControlRow {
  std::string track, world, law;
  grading::CrossTrack cross_track;  // in the windows alone
  bool is_judged = true;
  std::string end;  // where and why, if it ended early; else empty

  bool ended_early() const { return !end.empty(); }
};

// Where and why a run ends early: at a wall, or with a stop under green. Empty: it goes on.
std::string early_end(const pipeline::Outputs& out, const bench::Rig& rig, Instant now);

Result<ControlRow, Problem> run_control(const Plan& plan, const pipeline::Setup& setup);

}  // namespace pitwall::control_bench
