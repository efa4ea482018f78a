// The plant file that ships.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fstream>
#include <iterator>
#include <string>

#include "hil/plant/plant_file.hpp"

namespace pitwall::plant::testing {

inline const std::string& shipped() {
  static const std::string text = [] {
    std::ifstream file(std::string(PITWALL_SOURCE_DIR) + "/hil/config/plants/av21.yaml",
                       std::ios::binary);
    return std::string{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  }();
  return text;
}

// Why the text is refused; empty if it is read.
inline std::string refusal(const std::string& text) {
  const auto plant = read_plant(text, "plant.yaml");
  return plant ? std::string{} : to_string(plant.error());
}

}  // namespace pitwall::plant::testing
