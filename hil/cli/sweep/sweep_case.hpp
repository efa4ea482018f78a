// One case of a sweep, run in lockstep.
//   in     plan and scenario of the sweep, the case
//   out    verdict, margins, digest of the event log
//   errors read_sweep(): Problem of a file. run_case(): none, values that the bench does not take
//          are a refused case
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "hil/bench/lockstep/lockstep.hpp"
#include "hil/sweep/case_result.hpp"
#include "hil/sweep/cases.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::cli {

struct SweepInputs {
  sweep::Cases cases;
  std::string plan_text, scenario_text;
};

// The plan and its scenario.
Result<SweepInputs, Problem> read_sweep(const std::string& plan_file);

// May run on several threads at once. `step`: the car; a test may put another there.
sweep::CaseResult run_case(const SweepInputs& inputs, const sweep::Case& of,
                           const bench::StepFunction& step = pipeline::step);

// What the bench does not take of a plan: of each parameter its listed values, or the ends of its
// range, beside the first ones of the others. Nothing is run.
Result<bool, Problem> check_values(const std::string& scenario_text, const sweep::Plan& plan);

}  // namespace pitwall::cli
