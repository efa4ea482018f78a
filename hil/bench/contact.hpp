// Verdicts on a contact of the car with a wall or with another car, which ends a run.
//   in     the scenario, which may name a contact with a wall that cannot be avoided; the run's
//          verdicts, one for each expectation of the scenario, its outcome, its contact with a car
//   out    a verdict `contact` if there was one with a wall, or if the scenario names one: it fails
//          unless the contact is named and not harder than the scenario allows. A verdict
//          `car_contact` if there are other cars: it fails if this car caused one. Expectations
//          that the run could not show before the contact become remarks instead of verdicts
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "hil/bench/result.hpp"
#include "hil/scenario/scenario.hpp"

namespace pitwall::bench {

inline constexpr std::string_view kContactVerdict = "contact", kCarContactVerdict = "car_contact";

void judge_contact(const scenario::Scenario& scenario, RunResult& result);

}  // namespace pitwall::bench
