// SPDX-License-Identifier: Apache-2.0
#include "hil/scenario/expect_section.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "hil/scenario/radio_section.hpp"
#include "hil/scenario/scenario.hpp"

namespace pitwall::scenario {
namespace {

using grading::Condition;
using grading::Expectation;
using grading::Kind;

constexpr double kMostValue = 1e12;
constexpr double kShortest_s = 0.001, kLongestSpan_s = 10.0;
constexpr double kLeastQuantile = 0.001;

// The value that `words` names by the word at `key`.
template <class Enum>
Enum word_at(yaml::StrictMap& map, const char* key,
             std::optional<Enum> (*value_of)(std::string_view),
             std::span<const std::string_view> words) {
  const std::string word = map.text(key);
  if (const auto value = value_of(word)) return *value;
  std::string legal;
  for (const std::string_view one : words) legal += (legal.empty() ? "" : ", ") + std::string(one);
  map.fail(key, "\"" + word + "\" is not one of: " + legal);
}

Condition read_condition(yaml::StrictMap& map) {
  return {.signal = map.text("signal"),
          .op = word_at(map, "is", grading::op_of, grading::op_names()),
          .number = map.number("value", -kMostValue, kMostValue)};
}

// The condition of an own mapping: a trigger or a release.
Condition read_condition(yaml::StrictMap& map, const char* key) {
  yaml::StrictMap own = map.map(key);
  const Condition condition = read_condition(own);
  own.finish();
  return condition;
}

Instant time_at(yaml::StrictMap& map, const char* key) {
  return Instant{} + from_seconds(map.number(key, 0.0, kLongest_s));
}

Duration read_limit(yaml::StrictMap& map) {
  return from_seconds(map.number("within_s", kShortest_s, kLongest_s));
}

void read_window(yaml::StrictMap& map, Expectation& e) {
  if (map.has("from_s")) e.from = time_at(map, "from_s");
  if (e.kind == Kind::kUntil) return;  // its limit ends it
  if (map.has("until_s")) e.to = time_at(map, "until_s");
  if (e.to && *e.to <= e.from.value_or(Instant{}))
    map.fail("until_s", "the window ends before it begins");
}

// The faults are counted from 1, as a person counts them.
void read_detection(yaml::StrictMap& map, Expectation& e, std::span<const Instant> faults) {
  e.condition = map.has("monitor") ? Condition{.signal = "seen_" + map.text("monitor"),
                                               .op = grading::Op::kEqual,
                                               .number = 1.0}
                                   : read_condition(map);
  const auto number = map.integer_or("fault", 1, 1, static_cast<std::int64_t>(kMaxListed));
  if (static_cast<std::uint64_t>(number) > faults.size())
    map.fail("fault", "expected the number of an entry of faults, counted from 1");
  e.from = faults[static_cast<std::size_t>(number - 1)];
  e.limit = read_limit(map);
  e.to = *e.from + e.limit;
}

void read_quantile(yaml::StrictMap& map, Expectation& e) {
  e.share = map.number("quantile", kLeastQuantile, 1.0);
  if (!grading::is_ordering(e.condition.op)) map.fail("is", "of a quantile, expected < <= > or >=");
}

}  // namespace

Expectation read_expectation(yaml::StrictMap& map, std::span<const Instant> faults) {
  Expectation e{.name = map.place("kind"),
                .kind = word_at(map, "kind", grading::kind_of, grading::kind_names())};
  if (e.kind == Kind::kDetects) {
    read_detection(map, e, faults);
    map.finish();
    return e;
  }
  e.condition = read_condition(map);
  if (e.kind == Kind::kAfter) e.trigger = read_condition(map, "trigger");
  if (e.kind == Kind::kUntil) e.release = read_condition(map, "release");
  if (e.kind == Kind::kAfter || e.kind == Kind::kUntil) e.limit = read_limit(map);
  if (e.kind == Kind::kRate && map.has("over_s"))
    e.span = from_seconds(map.number("over_s", kShortest_s, kLongestSpan_s));
  if (e.kind == Kind::kQuantile) read_quantile(map, e);
  read_window(map, e);
  map.finish();
  return e;
}

}  // namespace pitwall::scenario
