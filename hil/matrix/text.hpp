// Text helpers of the matrix: printf into a string, lists for people and for JSON.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/json/json_text.hpp"

namespace pitwall::matrix {

template <class... Args>
std::string format(const char* pattern, Args... args) {
  std::array<char, 640> text{};
  std::snprintf(text.data(), text.size(), pattern, args...);
  return text.data();
}

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

}  // namespace pitwall::matrix
