// One case of a sweep, run in lockstep.
//   in     scenario text, the case's settings
//   out    verdict, margins, digest of the event log; the scenario text with the settings in it
//   errors none: values that the bench does not take are a refused case
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "hil/sweep/case_result.hpp"
#include "hil/sweep/cases.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::cli {

// `name`: of the scenario's file, for messages.
sweep::CaseResult run_case(const std::string& scenario_text, const std::string& name,
                           const sweep::Case& of);

// What the bench does not take of a plan: of each parameter its listed values, or the ends of its
// range, beside the first ones of the others. Nothing is run.
Result<bool, Problem> check_values(const std::string& scenario_text, const sweep::Plan& plan);

}  // namespace pitwall::cli
