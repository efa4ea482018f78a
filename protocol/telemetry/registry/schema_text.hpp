// Canonical text of the registry: two ends compare it and its hashes.
//   form   group NAME down|up safety|motion|health|statistics
//          FIELD UNIT MIN MAX RESOLUTION[ LABELS]        one line per field; no unit is "-"
//   invariants
//          each change in the meaning of a bit on the wire changes the text. Target ages and
//          weights concern the sender only and are not in the text
//   in     a Group; a sink that takes string_view
//   cost   usable at compile time
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "protocol/telemetry/registry/registry.hpp"
#include "protocol/vocabulary/check.hpp"

namespace pitwall::telemetry {

// Text of the registry in quotes; such texts have no character to escape.
inline std::string quoted(std::string_view text) { return '"' + std::string{text} + '"'; }

// Shortest decimal form of a number of a row, with at most six decimals. CHECKs that the number has
// no more.
class Decimal {
 public:
  constexpr explicit Decimal(double value) {
    const double scaled = (value < 0 ? -value : value) * kScale;
    const auto whole = static_cast<std::uint64_t>(scaled + 0.5);
    const double lost = scaled - static_cast<double>(whole);
    CHECK(scaled < 9e15 && lost < 1e-3 && lost > -1e-3);
    const bool fraction = put_fraction(whole % kScale);
    if (fraction) put('.');
    std::uint64_t rest = whole / kScale;
    do {
      put(static_cast<char>('0' + rest % 10));
      rest /= 10;
    } while (rest > 0);
    if (value < 0 && whole > 0) put('-');
  }
  constexpr std::string_view text() const { return {text_.data() + at_, text_.size() - at_}; }

 private:
  static constexpr std::uint64_t kScale = 1'000'000;

  constexpr bool put_fraction(std::uint64_t digits) {
    bool any = false;
    for (int place = 0; place < 6; ++place, digits /= 10) {
      if (digits % 10 == 0 && !any) continue;
      put(static_cast<char>('0' + digits % 10));
      any = true;
    }
    return any;
  }
  constexpr void put(char c) { text_[--at_] = c; }

  std::array<char, 24> text_{};
  std::size_t at_ = 24;
};

constexpr std::string_view text_of(Direction direction) {
  return direction == Direction::kDown ? "down" : "up";
}
constexpr std::string_view text_of(Class priority) {
  constexpr std::array<std::string_view, kClasses> kTexts{"safety", "motion", "health",
                                                          "statistics"};
  return kTexts[static_cast<std::size_t>(priority)];
}

template <class Sink>
constexpr void say_range(double min, double max, double resolution, Sink&& say) {
  say(Decimal{min}.text()), say(" ");
  say(Decimal{max}.text()), say(" ");
  say(Decimal{resolution}.text());
}

template <class Sink>
constexpr void say_field(const FieldRow& row, Sink&& say) {
  say(row.name), say(" ");
  say(row.unit.empty() ? std::string_view{"-"} : row.unit), say(" ");
  say_range(row.min, row.max, row.resolution, say);
  if (!row.labels.empty()) say(" "), say(row.labels);
  say("\n");
}

template <class Sink>
constexpr void say_group(Group group, Sink&& say) {
  const GroupRow& row = row_of(group);
  say("group "), say(row.name), say(" ");
  say(text_of(row.direction)), say(" ");
  say(text_of(row.priority)), say("\n");
  const auto [first, count] = fields_of(group);
  for (FieldIndex i = first; i < first + count; ++i) say_field(kFields[i], say);
}

}  // namespace pitwall::telemetry
