// Text of a small scenario to start from, with comments: the car drives away from standstill under
// yellow.
//   out    a scenario that passes on the shipped tracks with the shipped cars
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace pitwall::cli {

// The car needs so long to drive away and reach the speed that is asked of it.
inline constexpr double kShortestNew_s = 25.0;
inline constexpr const char* kScenarioSchema = "hil/config/schemas/scenario.schema.json";

struct NewScenario {
  std::string name;
  std::string track = "vehicle/config/tracks/lvms.yaml";
  std::string car = "vehicle/config/cars/av21.yaml";
  double duration_s = 40.0;              // at least kShortestNew_s
  std::string schema = kScenarioSchema;  // as an editor finds it from the scenario's folder
};

std::string new_scenario_text(const NewScenario& scenario);

}  // namespace pitwall::cli
