// Readers of the car-file sections about a stop and what it depends on: tyres, brakes and engine,
// the stop path.
//   in     the mapping of the section
//   out    parameters, each within its legal range
//   errors as in every section: thrown, with place and reason
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "protocol/yaml/strict_map.hpp"
#include "vehicle/pipeline/setup.hpp"

namespace pitwall::parameters {

envelope::FrictionParams read_friction(yaml::StrictMap map);
void read_stop_plan(yaml::StrictMap map, planning::Params& planning);

}  // namespace pitwall::parameters
