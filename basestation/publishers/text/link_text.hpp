// Figures of the radio link as lines of text: link, paths, ages, refusals, commands, events.
//   out    lines of at most kScreenColumns; an unknown value is shown as unknown
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "basestation/service/car_service.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::publishers {

inline constexpr std::size_t kScreenColumns = 144;

enum class Tone : std::uint8_t { kPlain, kBold, kDim, kWarning, kAlarm, kInverse };
struct TextLine {
  std::string text;
  Tone tone = Tone::kPlain;
};

std::string age_text(Duration age);  // "12 ms", "31 s"
std::vector<TextLine> link_lines(const service::CarService& car, Instant now);

}  // namespace pitwall::publishers
