// Plan of the speed benchmark: one run drives an oval at one speed after another, up and down
// through the gears, by the round speeds of race control.
//   in     a scenario of flying laps (its start, tyres and first flags), the limits of the planner
//   out    Scenario and its holds; the cars to drive
//   units  m/s, s of scenario time
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "hil/scenario/scenario.hpp"
#include "tests/benchmarks/control/control_plan.hpp"
#include "vehicle/autonomy/planning/planning.hpp"

namespace pitwall::speed_bench {

// A target speed, from its call to the next one.
struct Hold {
  double speed_mps = kUnset;
  Duration from{}, steady_from{}, until{};  // steady: the governed reference has long arrived
};

struct Plan {
  scenario::Scenario scenario;
  std::vector<Hold> holds;
  std::size_t step = 0;        // the hold that is graded as the step from 30 to 40 m/s
  std::size_t slow_downs = 0;  // holds that are slower than the one before
};

Plan plan_of(const scenario::Scenario& like, const planning::Params& limits);

// The worlds of the control benchmark that differ by the car alone.
std::vector<control_bench::World> cars();

}  // namespace pitwall::speed_bench
