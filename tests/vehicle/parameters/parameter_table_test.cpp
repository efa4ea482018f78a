// SPDX-License-Identifier: Apache-2.0
#include "vehicle/parameters/parameter_table.hpp"

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace pitwall::parameters {
namespace {

struct Line {
  std::string key, standard, least, most;
};

std::vector<Line> lines() {
  std::istringstream text(parameter_table());
  std::string heading;
  std::getline(text, heading);
  std::vector<Line> out;
  for (Line line; text >> line.key >> line.standard >> line.least >> line.most;)
    out.push_back(line);
  return out;
}

YAML::Node at(YAML::Node node, const std::string& key) {
  std::istringstream parts(key);
  for (std::string part; node.IsDefined() && std::getline(parts, part, '.');)
    node.reset(node[part]);
  return node;
}

// The car that ships has every number of the table, at the place that the table names, or it may be
// left out and has the default.
TEST(ParameterTable, NamesThePlacesOfTheCarFile) {
  const YAML::Node car = YAML::LoadFile(PITWALL_SOURCE_DIR "/vehicle/config/cars/av21.yaml");
  std::set<std::string> keys;
  for (const Line& line : lines()) {
    EXPECT_TRUE(keys.insert(line.key).second) << line.key << " is there twice";
    const YAML::Node value = at(car, line.key);
    if (line.key.starts_with("planning.passing.")) continue;  // a section that it may do without
    if (!value.IsDefined()) {
      const bool optional =
          line.key.starts_with("localization.checks.") || line.key.starts_with("fuel.");
      EXPECT_TRUE(optional) << line.key;
      EXPECT_NE(line.standard, "required") << line.key;
      continue;
    }
    EXPECT_GE(value.as<double>(), std::stod(line.least)) << line.key;
    EXPECT_LE(value.as<double>(), std::stod(line.most)) << line.key;
  }
  EXPECT_GT(keys.size(), 150u);
}

TEST(ParameterTable, ADefaultIsLegal) {
  for (const Line& line : lines()) {
    if (line.standard == "required") continue;
    EXPECT_GE(std::stod(line.standard), std::stod(line.least)) << line.key;
    EXPECT_LE(std::stod(line.standard), std::stod(line.most)) << line.key;
  }
}

}  // namespace
}  // namespace pitwall::parameters
