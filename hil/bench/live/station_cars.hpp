// Cars file of a base station that serves several cars (basestation/settings/cars_file.hpp).
//   in     what each car has of its own; paths as the file shall have them, that is absolute or
//          relative to its folder
//   out    text of the file: JSON, which is YAML. Empty texts are left out
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

namespace pitwall::bench {

struct StationCar {
  int number = 0;
  std::string name{}, keys{}, json{};
  std::vector<std::string> listen{};  // an address for each path of the radio
  std::string record{}, judgement{}, command_socket{}, commands{};
};

std::string cars_text(std::span<const StationCar> cars);

}  // namespace pitwall::bench
