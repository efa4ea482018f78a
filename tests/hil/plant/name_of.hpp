// Full name of a plant entry: section and key.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "hil/plant/entries.hpp"

namespace pitwall::plant {

inline std::string name_of(const Entry& e) {
  return std::string(e.section) + "." + std::string(e.key);
}

}  // namespace pitwall::plant
