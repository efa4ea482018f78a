// SPDX-License-Identifier: Apache-2.0
#include "protocol/yaml/edited.hpp"

#include <yaml-cpp/yaml.h>

#include <charconv>
#include <optional>
#include <variant>
#include <vector>

namespace pitwall::yaml {
namespace {

using Step = std::variant<std::string, std::size_t>;  // a key, or a place in a list

// nullopt: no path, such as "a..b" or "a[x]".
std::optional<std::vector<Step>> steps_of(std::string_view path) {
  std::vector<Step> steps;
  while (!path.empty()) {
    if (path.front() == '[') {
      const std::size_t end = path.find(']');
      std::size_t place = 0;
      if (end == std::string_view::npos || steps.empty()) return std::nullopt;
      const std::string_view digits = path.substr(1, end - 1);
      const auto [rest, error] =
          std::from_chars(digits.data(), digits.data() + digits.size(), place);
      if (error != std::errc{} || rest != digits.data() + digits.size()) return std::nullopt;
      steps.emplace_back(place);
      path.remove_prefix(end + 1);
      continue;
    }
    if (!steps.empty()) {
      if (path.front() != '.') return std::nullopt;
      path.remove_prefix(1);
    }
    const std::string_view key = path.substr(0, path.find_first_of(".[]"));
    if (key.empty()) return std::nullopt;
    steps.emplace_back(std::string{key});
    path.remove_prefix(key.size());
  }
  if (steps.empty()) return std::nullopt;
  return steps;
}

std::string text_of(const Step& step) {
  if (const auto* key = std::get_if<std::string>(&step)) return "\"" + *key + "\"";
  return "[" + std::to_string(std::get<std::size_t>(step)) + "]";
}

// The node that the step leads to, made if it is a key that is missing; empty text: it exists now.
std::string walk(YAML::Node& node, const Step& step, bool is_last) {
  if (const auto* place = std::get_if<std::size_t>(&step)) {
    if (!node.IsSequence()) return text_of(step) + ": there is no list";
    if (*place >= node.size())
      return text_of(step) + ": the list has " + std::to_string(node.size()) + " entries";
    node.reset(node[*place]);
    return {};
  }
  const auto& key = std::get<std::string>(step);
  if (!node.IsMap()) return text_of(step) + ": there is no mapping";
  if (!node[key].IsDefined())
    node[key] = is_last ? YAML::Node(YAML::NodeType::Null) : YAML::Node(YAML::NodeType::Map);
  node.reset(node[key]);
  return {};
}

std::string set(YAML::Node node, const Setting& setting) {
  const auto steps = steps_of(setting.path);
  if (!steps) return "expected a path such as perturb.friction or faults[0].value";
  for (std::size_t i = 0; i < steps->size(); ++i) {
    const std::string why = walk(node, (*steps)[i], i + 1 == steps->size());
    if (!why.empty()) return why;
  }
  const YAML::Node value = YAML::Load(setting.value);
  if (!value.IsScalar()) return "expected a number or a word as its value";
  if (node.IsMap() || node.IsSequence()) return "is no value, but holds others";
  node = value;
  return {};
}

}  // namespace

Result<std::string, Problem> with_settings(std::string_view text, const std::string& name,
                                           std::span<const Setting> settings) {
  try {
    const YAML::Node root = YAML::Load(std::string{text});
    if (!root.IsMap()) return Unexpected{Problem{name, "expected a mapping"}};
    for (const Setting& setting : settings)
      if (const std::string why = set(root, setting); !why.empty())
        return Unexpected{Problem{name, setting.path + ": " + why}};
    YAML::Emitter out;
    out << root;
    return std::string{out.c_str()} + "\n";
  } catch (const YAML::Exception& error) {
    return Unexpected{Problem{name, error.what()}};
  }
}

}  // namespace pitwall::yaml
