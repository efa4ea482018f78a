// Reader of car files (vehicle/config/cars/*.yaml) into pipeline::CarParams. It is strict: every
// key is known and every number in its legal range; an optional key has the default of its module.
//   in     the file and those that it is like (car_layers.hpp); or the text of one that stands
//          alone, with its name for messages
//   out    CarFile
//   errors Problem with file:line:column
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "protocol/vocabulary/result.hpp"
#include "protocol/yaml/strict_map.hpp"
#include "vehicle/parameters/car_layers.hpp"
#include "vehicle/pipeline/setup.hpp"

namespace pitwall::parameters {

// A car for one CAN database.
struct CarFile {
  std::string name;
  std::string database;  // revision of the database on the car's bus, "av21"
  std::string source;    // file: what it names lies relative to its folder
  std::string text;      // whole_text(): for what is recorded of the run
  pipeline::CarParams params;
};

Result<CarFile, Problem> load_car(const std::string& path, const ReadFile& read_file);
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
