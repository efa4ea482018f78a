// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/frames/restamp_rules.hpp"

#include <algorithm>
#include <tuple>

#include "protocol/can/signal.hpp"
#include "protocol/vocabulary/check.hpp"

namespace pitwall::replay {
namespace {

constexpr std::uint32_t kLargestBottom = 1;  // senders start again at 0 or at 1

auto key_of(bool extended, std::uint32_t id) { return std::tuple{extended, id}; }

bool is_range_fixed(can::Protection profile) {
  return profile != can::Protection::kNone && profile != can::Protection::kJ1850;
}

}  // namespace

std::uint32_t RestampRule::counter_of(const can::Frame& frame) const {
  const std::uint64_t word = can::load_intel(frame.data, counter_start / 8U);
  return static_cast<std::uint32_t>(word >> counter_start % 8U & can::mask_of(counter_bits));
}

void RestampRule::stamp(can::Frame& frame, std::uint32_t counter) const {
  if (counter_bits > 0) {
    const std::size_t byte = counter_start / 8U;
    const unsigned shift = counter_start % 8U;
    const std::uint64_t mask = can::mask_of(counter_bits) << shift;
    const std::uint64_t kept = can::load_intel(frame.data, byte) & ~mask;
    can::store_intel(frame.data, kept | (std::uint64_t{counter} << shift & mask), byte);
  }
  can::ProtectState state{counter};
  can::protect(protection, state, frame);
}

Result<RestampRules, Problem> RestampRules::make(const can::Manifest& manifest,
                                                 const can::Database& database) {
  if (auto problem = can::refusal_of(database)) return Unexpected{*problem};
  if (auto problem = can::contradiction(manifest, database)) return Unexpected{*problem};
  RestampRules out{.name = manifest.name, .rules = {}};
  const std::vector<can::MessageRow> rows = can::rows(manifest, database);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const can::MessageRow& row = rows[i];
    if (!row.has_counter && row.protection.profile == can::Protection::kNone) continue;
    out.rules.push_back({.id = row.id,
                         .extended = database.messages[i].extended,
                         .length = row.length,
                         .counter_start = row.counter_start,
                         .counter_bits = row.counter_bits,
                         .protection = row.protection});
  }
  if (out.rules.empty())
    return refuse(manifest.name, "has no message with a counter or a checksum: nothing to stamp");
  std::ranges::sort(out.rules, {}, [](const RestampRule& r) { return key_of(r.extended, r.id); });
  return out;
}

std::size_t RestampRules::place_of(const can::Frame& frame) const {
  const auto key = key_of(frame.extended, frame.id);
  const auto found = std::ranges::lower_bound(
      rules, key, {}, [](const RestampRule& r) { return key_of(r.extended, r.id); });
  if (found == rules.end() || key_of(found->extended, found->id) != key) return kNone;
  return static_cast<std::size_t>(found - rules.begin());
}

bool RestampRules::fits(const RestampRule& rule, const can::Frame& frame) {
  return !frame.remote && frame.length == rule.length;
}

void CounterHistory::observe(const can::Frame& frame) {
  const std::size_t place = rules_->place_of(frame);
  if (place == RestampRules::kNone) return;
  const RestampRule& rule = rules_->rules[place];
  if (rule.counter_bits == 0 || !RestampRules::fits(rule, frame)) return;
  Seen& seen = seen_[place];
  const std::uint32_t value = rule.counter_of(frame);
  if (seen.ever && value < seen.last && value <= kLargestBottom) ++seen.wraps[{seen.last, value}];
  seen.ever = true;
  seen.last = value;
}

CounterRange CounterHistory::range_of(std::size_t place) const {
  const RestampRule& rule = rules_->rules[place];
  CHECK(rule.counter_bits > 0);
  if (is_range_fixed(rule.protection.profile))
    return {.bottom = 0, .top = can::counter_top(rule.protection)};
  const auto& wraps = seen_[place].wraps;
  const auto most = std::ranges::max_element(wraps, {}, [](const auto& wrap) {
    return std::pair{wrap.second, wrap.first.first};  // of equals the later wrap
  });
  if (most != wraps.end() && most->second >= kMinWraps)
    return {.bottom = most->first.second, .top = most->first.first};
  return {.bottom = 0, .top = static_cast<std::uint32_t>(can::mask_of(rule.counter_bits))};
}

}  // namespace pitwall::replay
