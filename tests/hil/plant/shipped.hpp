// Loader of the shipped plant files.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

#include "hil/plant/plant_file.hpp"

namespace pitwall::plant::testing {

inline std::string shipped(const std::string& name = "av21") {
  std::ifstream file(std::string(PITWALL_SOURCE_DIR) + "/hil/config/plants/" + name + ".yaml",
                     std::ios::binary);
  return std::string{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

inline PlantFile shipped_car(const std::string& name) {
  const auto file = read_plant(shipped(name), name + ".yaml");
  if (!file) ADD_FAILURE() << to_string(file.error());
  return file.value_or(PlantFile{});
}

// The reason why the text is refused; empty if it is valid.
inline std::string refusal(const std::string& text) {
  const auto plant = read_plant(text, "plant.yaml");
  return plant ? std::string{} : to_string(plant.error());
}

}  // namespace pitwall::plant::testing
