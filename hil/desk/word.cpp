// SPDX-License-Identifier: Apache-2.0
#include "hil/desk/word.hpp"

#include <cmath>

#include "protocol/json/json_value.hpp"

namespace pitwall::desk {
namespace {

Result<Word, Problem> start_word(const json::JsonValue& value, std::string by) {
  StartWord word{.scenario = value.text("scenario"), .seed = {}, .by = std::move(by)};
  if (word.scenario.empty() || word.scenario.size() > kNameMax)
    return refuse("scenario", "a text of 1 to " + std::to_string(kNameMax) + " bytes");
  const std::string mode = value.text("mode");
  if (mode != "lockstep" && mode != "live") return refuse("mode", "one of lockstep, live");
  word.live = mode == "live";
  const json::JsonValue* const seed = value.find("seed");
  if (seed == nullptr || seed->is_null()) return Word{word};
  const double number = seed->number();
  if (!(number >= 0.0 && number <= static_cast<double>(kSeedMax)) || number != std::floor(number))
    return refuse("seed", "a whole number from 0 to " + std::to_string(kSeedMax));
  word.seed = static_cast<std::uint64_t>(number);
  return Word{word};
}

}  // namespace

Result<Word, Problem> parse_word(std::string_view line) {
  const auto value = json::JsonValue::parse(line, "line");
  if (!value) return Unexpected{value.error()};
  std::string by = value->text("by");
  if (by.size() > kNameMax) return refuse("by", "at most " + std::to_string(kNameMax) + " bytes");
  const std::string wish = value->text("do");
  if (wish == "start") return start_word(*value, std::move(by));
  if (wish == "stop") return Word{StopWord{std::move(by)}};
  return refuse("do", "one of start, stop");
}

}  // namespace pitwall::desk
