// Inputs of the alarm evaluator as texts of a recording.
//   in     inputs of an Evaluator; the settings in force
//   out    one JSON object each: {"type": "judge" (settings) or "input", "time_ms", "what", ...}
//   invariants
//          reading a text gives exactly the input that was written, to the bit
//   errors read: Problem for a text that is not a known input
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "basestation/alarms/evaluator.hpp"
#include "basestation/alarms/evaluator_input.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::service {

struct EvaluatorSettings {
  bool begins = false;  // a new process begins to evaluate: earlier alarm states do not hold
  alarms::EvaluatorConfig config;  // without a course
};

std::string judge_text(const alarms::Evaluator& evaluator, bool begins, Instant now);
Result<EvaluatorSettings, Problem> read_judge_text(std::string_view text);

std::string input_text(const alarms::EvaluatorInput& input, Instant now);
Result<alarms::EvaluatorInput, Problem> read_input_text(std::string_view text, Instant at);

}  // namespace pitwall::service
