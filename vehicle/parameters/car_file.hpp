// A car as a person writes it (vehicle/config/cars/*.yaml) to pipeline::CarParams. Strict: every
// key
// is known, every number in its legal range; what may be left out has the default of its module.
//   in     text of the file, its name for messages
//   errors Problem with file:line:column
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "protocol/vocabulary/result.hpp"
#include "protocol/yaml/strict_map.hpp"
#include "vehicle/pipeline/setup.hpp"

namespace pitwall::parameters {

// One file of the format, for one database. A car that speaks another is another file.
struct CarFile {
  std::string name;
  std::string database;  // revision that the car must speak, "av21"
  pipeline::CarParams params;
};

Result<CarFile, Problem> read_car(const std::string& text, const std::string& name);

// Sections of the file, each in its own source file.
localization::Params read_localization(yaml::StrictMap map, world::Receivers& receivers);
planning::Params read_planning(yaml::StrictMap map);
control::Params read_control(yaml::StrictMap map);
void read_gateway(yaml::StrictMap map, pipeline::CarParams& params);
void read_safety(yaml::StrictMap map, pipeline::CarParams& params);
void read_radio(yaml::StrictMap map, pipeline::CarParams& params);  // after safety

}  // namespace pitwall::parameters
