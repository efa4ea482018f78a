// Lists of words as text and as JSON.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "protocol/json/json_text.hpp"

namespace pitwall::fault_coverage {

inline std::string list_of(const std::vector<std::string>& words) {
  std::string out;
  for (const std::string& word : words) out += (out.empty() ? "" : ", ") + word;
  return out;
}

inline std::string json_list(const std::vector<std::string>& words) {
  json::Array out;
  for (const std::string& word : words) out.json(json::quoted(word));
  return out.str();
}

}  // namespace pitwall::fault_coverage
