// SPDX-License-Identifier: Apache-2.0
#include "protocol/ros/names.hpp"

#include <algorithm>

#include "protocol/vocabulary/check.hpp"

namespace pitwall::ros {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_word(char c) {
  return is_digit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

// Empty where a topic may be called so.
std::string fault_of(std::string_view topic) {
  if (topic.empty() || topic.front() != '/') return "does not begin with '/'";
  if (topic.size() > kTopicMax) return "longer than " + std::to_string(kTopicMax) + " characters";
  if (topic.back() == '/') return "ends with '/'";
  for (std::size_t i = 0; i < topic.size(); ++i) {
    const char c = topic[i];
    if (c != '/' && !is_word(c)) return std::string("holds '") + c + "'";
    if (i == 0 || topic[i - 1] != '/') continue;
    if (c == '/') return "holds '//'";
    if (is_digit(c)) return "a part begins with a digit";
  }
  return {};
}

}  // namespace

Result<std::string, Problem> dds_topic(std::string_view topic) {
  if (std::string fault = fault_of(topic); !fault.empty())
    return Unexpected{Problem{"topic '" + std::string(topic) + "'", std::move(fault)}};
  return "rt" + std::string(topic);
}

std::string dds_type(std::string_view type) {
  const std::size_t package = type.find('/');
  const std::size_t kind = type.find('/', package + 1);
  CHECK(package != type.npos && kind != type.npos);
  return std::string(type.substr(0, package)) +
         "::" + std::string(type.substr(package + 1, kind - package - 1)) +
         "::dds_::" + std::string(type.substr(kind + 1)) + "_";
}

}  // namespace pitwall::ros
