// Text helpers of the matrix: printf into a string, lists for people and for JSON.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

namespace pitwall::matrix {

template <class... Args>
std::string format(const char* pattern, Args... args) {
  std::array<char, 640> text{};
  std::snprintf(text.data(), text.size(), pattern, args...);
  return text.data();
}

// As a JSON string; what JSON would have to escape becomes a blank.
inline std::string in_quotes(std::string_view words) {
  std::string out = "\"";
  for (const char c : words) {
    const bool plain = c != '"' && c != '\\' && static_cast<unsigned char>(c) >= 0x20;
    out += plain ? c : ' ';
  }
  return out + "\"";
}

inline std::string list_of(const std::vector<std::string>& words) {
  std::string out;
  for (const std::string& word : words) out += (out.empty() ? "" : ", ") + word;
  return out;
}

inline std::string json_list(const std::vector<std::string>& words) {
  std::string out;
  for (const std::string& word : words) out += (out.empty() ? "" : ",") + in_quotes(word);
  return "[" + out + "]";
}

}  // namespace pitwall::matrix
