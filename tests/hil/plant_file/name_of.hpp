// The name of an entry, with its section.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "hil/plant_file/entries.hpp"

namespace pitwall::plant_file {

inline std::string name_of(const Entry& e) {
  return std::string(e.section) + "." + std::string(e.key);
}

}  // namespace pitwall::plant_file
