// SPDX-License-Identifier: Apache-2.0
#include "hil/sweep/plan.hpp"

#include <algorithm>

#include "protocol/vocabulary/text.hpp"
#include "protocol/yaml/strict_map.hpp"

namespace pitwall::sweep {
namespace {

constexpr double kLargest = 1e12;
constexpr std::int64_t kSeedMost = 1'000'000'000;

Combine read_combine(yaml::StrictMap& map) {
  const std::string word = map.text("combine");
  if (word == "draw") return Combine::kDraw;
  if (word == "all") return Combine::kAll;
  if (word == "pairs") return Combine::kPairs;
  map.fail("combine", "expected draw, all or pairs, found \"" + word + "\"");
}

Parameter read_parameter(yaml::StrictMap& map, Combine combine) {
  Parameter parameter{.path = map.text("path")};
  if (map.has("values")) {
    parameter.values = map.texts("values", 1, kValuesMost);
    for (const char* key : {"from", "to"})
      if (map.has(key)) map.fail(key, "a parameter has values or a range, not both");
  } else {
    if (combine != Combine::kDraw)
      map.fail("path", parameter.path + " has no `values`: a range is for combine: draw");
    parameter.from = map.number("from", -kLargest, kLargest);
    parameter.to = map.number("to", -kLargest, kLargest);
    if (!(parameter.from < parameter.to)) map.fail("to", "the range is empty");
  }
  map.finish();
  return parameter;
}

void check_paths(yaml::StrictMap& map, const std::vector<Parameter>& parameters) {
  for (std::size_t i = 0; i < parameters.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (parameters[i].path == parameters[k].path)
        map.fail("parameters", parameters[i].path + " is there twice");
}

// Of kAll, or as many as two parameters with most values need, of kPairs.
void check_size(yaml::StrictMap& map, const Plan& plan) {
  double cases = static_cast<double>(plan.repeats);
  std::vector<std::size_t> counts;
  for (const Parameter& parameter : plan.parameters) counts.push_back(parameter.values.size());
  std::ranges::sort(counts, std::ranges::greater{});
  if (plan.combine == Combine::kPairs && counts.size() > 2) counts.resize(2);
  for (const std::size_t count : counts) cases *= static_cast<double>(count);
  if (cases > static_cast<double>(kCasesMost))
    map.fail("parameters", formatted("%.0f cases, at most %zu", cases, kCasesMost));
}

Plan read_root(yaml::StrictMap& map) {
  if (map.integer("schema", 0, 1000) != 1) map.fail("schema", "this bench reads schema 1");
  Plan plan{.name = map.text("name"), .scenario_file = map.text("scenario")};
  plan.seed = static_cast<std::uint64_t>(map.integer("seed", 0, kSeedMost));
  plan.combine = read_combine(map);
  constexpr auto kMost = static_cast<std::int64_t>(kCasesMost);
  if (plan.combine == Combine::kDraw)
    plan.cases = static_cast<std::size_t>(map.integer("cases", 1, kMost));
  else
    plan.repeats = static_cast<std::size_t>(map.integer_or("repeats", 1, 1, kMost));
  std::vector<yaml::StrictMap> entries = map.maps("parameters");
  if (entries.size() > kParametersMost)
    map.fail("parameters", formatted("%zu, at most %zu", entries.size(), kParametersMost));
  if (entries.empty() && plan.combine == Combine::kPairs)
    map.fail("parameters", "there is nothing to pair");
  for (yaml::StrictMap& entry : entries)
    plan.parameters.push_back(read_parameter(entry, plan.combine));
  check_paths(map, plan.parameters);
  if (plan.combine != Combine::kDraw) check_size(map, plan);
  return plan;
}

}  // namespace

Result<Plan, Problem> read_plan(const std::string& text, const std::string& name) {
  const auto document = yaml::load_text(text, name);
  if (!document) return Unexpected{document.error()};
  return yaml::read(*document, read_root);
}

}  // namespace pitwall::sweep
