// Zero of the stamps in file formats that have a start date and offsets from it.
//   in     a log
//   out    the millisecond of the earliest frame; 1970 for a log without frames
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "hil/replay/formats/can_log.hpp"

namespace pitwall::replay {

inline UtcTime start_of(const CanLog& log) {
  const auto first =
      std::min_element(log.frames.begin(), log.frames.end(),
                       [](const LoggedFrame& a, const LoggedFrame& b) { return a.at < b.at; });
  if (first == log.frames.end()) return {};
  return {first->at.ns - first->at.ns % kNanosecondsPerMillisecond};
}

}  // namespace pitwall::replay
