// SPDX-License-Identifier: Apache-2.0
#include "hil/sweep/case_result.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "protocol/json/json_text.hpp"
#include "protocol/json/json_value.hpp"
#include "protocol/vocabulary/check.hpp"

namespace pitwall::sweep {
namespace {

constexpr std::array<const char*, kCaseVerdicts> kNames{"passed", "failed", "contact", "refused",
                                                        "crashed"};

std::optional<CaseVerdict> verdict_named(std::string_view name) {
  const auto* const found = std::ranges::find(kNames, name);
  if (found == kNames.end()) return std::nullopt;
  return static_cast<CaseVerdict>(found - kNames.begin());
}

}  // namespace

const char* name_of(CaseVerdict verdict) { return kNames[static_cast<std::size_t>(verdict)]; }

const CaseResult& result_of(std::span<const CaseResult> results, std::size_t number) {
  const auto found = std::ranges::lower_bound(results, number, {}, &CaseResult::number);
  CHECK(found != results.end() && found->number == number);
  return *found;
}

std::string to_line(const CaseResult& result) {
  json::Array margins;
  for (const ExpectationMargin& of : result.margins)
    margins.json(json::Object{}
                     .text("text", of.text)
                     .number("margin", of.margin)
                     .flag("pass", of.pass)
                     .str());
  return json::Object{}
      .number("case", result.number)
      .text("verdict", name_of(result.verdict))
      .text("why", result.why)
      .text("digest", result.digest)
      .number("simulated_s", result.simulated_s)
      .number("wall_s", result.wall_s)
      .json("margins", margins.str())
      .str();
}

std::optional<CaseResult> parse_case_result(std::string_view line) {
  const auto json = json::JsonValue::parse(line, "case");
  if (!json || !json->is_object()) return std::nullopt;
  const double number = json->number("case");
  const auto verdict = verdict_named(json->text("verdict"));
  if (!(number >= 0.0) || number != std::floor(number) || !verdict) return std::nullopt;
  CaseResult result{.number = static_cast<std::size_t>(number), .verdict = *verdict};
  result.why = json->text("why"), result.digest = json->text("digest");
  result.simulated_s = json->number("simulated_s"), result.wall_s = json->number("wall_s");
  for (const json::JsonValue& of : json->items("margins"))
    result.margins.push_back({of.text("text"), of.number("margin"), of.flag("pass")});
  return result;
}

}  // namespace pitwall::sweep
