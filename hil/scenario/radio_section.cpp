// SPDX-License-Identifier: Apache-2.0
#include "hil/scenario/radio_section.hpp"

#include <algorithm>
#include <utility>

namespace pitwall::scenario {
namespace {

constexpr double kSlowest_ms = 10'000.0, kFastest_kbit = 1e6;
constexpr double kMaxFadeLoss = 0.95;
constexpr double kBitsPerByte = 8.0, kKilo = 1e3;
constexpr std::int64_t kMaxQueue = 1 << 24;
constexpr std::size_t kMaxWords = 100'000;
constexpr std::size_t kMaxBlackouts = 64;

Duration time_of(yaml::StrictMap& map, const char* key, double fallback_ms) {
  return from_seconds(map.number_or(key, fallback_ms, 0.0, kSlowest_ms) / kKilo);
}

std::vector<link::Blackout> read_blackouts(yaml::StrictMap& map) {
  std::vector<link::Blackout> blackouts;
  if (!map.has("blackouts")) return blackouts;
  std::vector<yaml::StrictMap> rows = map.maps("blackouts");
  if (rows.size() > kMaxBlackouts) map.fail("blackouts", "expected at most 64");
  for (yaml::StrictMap& row : rows) {
    const double for_s = row.number("for_s", 0.001, kLongest_s);
    const double every_s = row.number_or("every_s", 0.0, 0.0, kLongest_s);
    if (every_s > 0.0 && every_s <= for_s)
      row.fail("every_s", "must be longer than for_s: the blackouts would overlap");
    blackouts.push_back({.from = Instant{} + from_seconds(row.number("at_s", 0.0, kLongest_s)),
                         .length = from_seconds(for_s),
                         .every = from_seconds(every_s)});
    row.finish();
  }
  return blackouts;
}

RadioPath read_path(yaml::StrictMap& map) {
  const double fade_loss = map.number_or("fade_loss", 0.0, 0.0, kMaxFadeLoss);
  if (fade_loss > 0.0 && !map.has("fade_ms")) map.fail("fade_loss", "needs fade_ms too");
  if (map.has("fade_ms") && fade_loss <= 0.0) map.fail("fade_ms", "needs fade_loss too");
  RadioPath path;
  path.link =
      link::bursty(fade_loss, time_of(map, "fade_ms", 0.0),
                   map.number_or("rate_kbit", 0.0, 0.0, kFastest_kbit) * kKilo / kBitsPerByte,
                   time_of(map, "delay_ms", 0.0));
  path.link.queue_bytes = static_cast<std::size_t>(map.integer_or(
      "queue_bytes", static_cast<std::int64_t>(path.link.queue_bytes), 0, kMaxQueue));
  path.link.jitter = time_of(map, "jitter_ms", 0.0);
  path.link.loss = map.number_or("loss", 0.0, 0.0, 1.0);
  path.link.duplicate = map.number_or("duplicate", 0.0, 0.0, 1.0);
  path.link.corrupt = map.number_or("corrupt", 0.0, 0.0, 1.0);
  path.link.blackouts = read_blackouts(map);
  if (map.has("seed")) path.seed = static_cast<std::uint64_t>(map.integer("seed", 0, kMaxSeed));
  map.finish();
  return path;
}

void read_word(yaml::StrictMap& row, std::vector<OperatorText>& words) {
  const double at_s = row.number("at_s", 0.0, kLongest_s);
  const std::string text = row.text("say");
  if (text.empty()) row.fail("say", "is empty");
  const bool repeats = row.has("every_s");
  if (repeats != row.has("until_s"))
    row.fail("say", "expected both every_s and until_s, or neither");
  const double every_s = repeats ? row.number("every_s", 0.01, kLongest_s) : kLongest_s;
  const double until_s = repeats ? row.number("until_s", at_s, kLongest_s) : at_s;
  row.finish();
  for (Duration at = from_seconds(at_s); at <= from_seconds(until_s);
       at = at + from_seconds(every_s)) {
    if (words.size() == kMaxWords) row.fail("say", "more than 100 000 texts in all");
    words.push_back({at, text});
  }
}

}  // namespace

std::vector<RadioPath> read_radio(yaml::StrictMap& map) {
  std::vector<RadioPath> paths;
  if (!map.has("radio")) return paths;
  for (yaml::StrictMap& row : map.maps("radio")) {
    if (paths.size() == kMaxPaths) map.fail("radio", "expected one or two paths");
    paths.push_back(read_path(row));
  }
  if (paths.empty()) map.fail("radio", "expected one or two paths");
  return paths;
}

std::vector<OperatorText> read_operator(yaml::StrictMap& map) {
  std::vector<OperatorText> words;
  if (!map.has("operator")) return words;
  for (yaml::StrictMap& row : map.maps("operator")) read_word(row, words);
  std::stable_sort(words.begin(), words.end(),
                   [](const OperatorText& a, const OperatorText& b) { return a.at < b.at; });
  return words;
}

}  // namespace pitwall::scenario
