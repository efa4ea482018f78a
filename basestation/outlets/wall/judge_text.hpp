// What the judge is told, as the texts of a recording.
//   in     inputs of a Watch; the settings that are in force
//   out    one JSON object each: {"type": "judge" (settings) or "input", "time_ms", "what", ...}
//   law    a text that is read gives the very input that was written, to the bit
//   errors read: Problem for a text of no known input
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "basestation/picture/watch/input.hpp"
#include "basestation/picture/watch/watch.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::outlets::wall {

struct JudgeSettings {
  bool begins = false;  // a process begins to judge: nothing of what was judged before holds
  picture::WatchConfig config;  // without a course
};

std::string judge_text(const picture::Watch& watch, bool begins, Instant now);
Result<JudgeSettings, Problem> read_judge_text(std::string_view text);

std::string input_text(const picture::WatchInput& input, Instant now);
Result<picture::WatchInput, Problem> read_input_text(std::string_view text, Instant at);

}  // namespace pitwall::outlets::wall
