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
constexpr void write_range(double min, double max, double resolution, Sink&& write) {
  write(Decimal{min}.text()), write(" ");
  write(Decimal{max}.text()), write(" ");
  write(Decimal{resolution}.text());
}

template <class Sink>
constexpr void write_field(const FieldRow& row, Sink&& write) {
  write(row.name), write(" ");
  write(row.unit.empty() ? std::string_view{"-"} : row.unit), write(" ");
  write_range(row.min, row.max, row.resolution, write);
  if (!row.labels.empty()) write(" "), write(row.labels);
  write("\n");
}

template <class Sink>
constexpr void write_group(Group group, Sink&& write) {
  const GroupRow& row = row_of(group);
  write("group "), write(row.name), write(" ");
  write(text_of(row.direction)), write(" ");
  write(text_of(row.priority)), write("\n");
  const auto [first, count] = fields_of(group);
  for (FieldIndex i = first; i < first + count; ++i) write_field(kFields[i], write);
}

}  // namespace pitwall::telemetry
