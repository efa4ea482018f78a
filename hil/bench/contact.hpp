// End of a run by a contact with a wall.
//   in     the scenario, which may name a contact that it cannot avoid; a run's verdicts, one for
//          each expectation of the scenario, and where the car went
//   out    a verdict `contact` where there was one, or where the scenario names one: it fails
//          unless the contact is named and not harder than the scenario says. What the run had not
//          shown by then is no verdict but a remark
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "hil/bench/result.hpp"
#include "hil/scenario/scenario.hpp"

namespace pitwall::bench {

inline constexpr std::string_view kContactVerdict = "contact";

void judge_contact(const scenario::Scenario& scenario, RunResult& result);

}  // namespace pitwall::bench
