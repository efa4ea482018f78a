// Reader of car files (vehicle/config/cars/*.yaml) into pipeline::CarParams. It is strict: every
// key is known and every number in its legal range; an optional key has the default of its module.
//   in     text of the file, its name for messages
//   out    CarFile
//   errors Problem with file:line:column
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "protocol/vocabulary/result.hpp"
#include "protocol/yaml/strict_map.hpp"
#include "vehicle/pipeline/setup.hpp"

namespace pitwall::parameters {

// Content of one file, for one CAN database.
struct CarFile {
  std::string name;
  std::string database;  // revision of the database on the car's bus, "av21"
  std::string source;    // file: what it names lies relative to its folder
  pipeline::CarParams params;
};

Result<CarFile, Problem> read_car(const std::string& text, const std::string& name);

// Sections of the file, each in its own source file.
localization::Params read_localization(yaml::StrictMap map, world::Receivers& receivers);
tracking::Params read_tracking(yaml::StrictMap map);
planning::Params read_planning(yaml::StrictMap map);
control::Params read_control(yaml::StrictMap map);
void read_gateway(yaml::StrictMap map, pipeline::CarParams& params);
void read_safety(yaml::StrictMap map, pipeline::CarParams& params);
void read_radio(yaml::StrictMap map, pipeline::CarParams& params);  // after safety

}  // namespace pitwall::parameters
