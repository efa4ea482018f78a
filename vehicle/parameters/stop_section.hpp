// Sections of the car file about a stop and what it stands on: tyres and brakes, its path, the law
// that steers while the car drives.
//   in     the mapping of the section
//   out    parameters, each within its legal range
//   errors the file's: place and reason, thrown as by every section
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "protocol/yaml/strict_map.hpp"
#include "vehicle/pipeline/setup.hpp"

namespace pitwall::parameters {

planning::FrictionParams read_friction(yaml::StrictMap map);
void read_stop_plan(yaml::StrictMap map, planning::Params& planning);
control::LateralLaw read_law(yaml::StrictMap& map, const char* key);

}  // namespace pitwall::parameters
