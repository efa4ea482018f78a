// File of the limits and alarms that operators have changed: read at the start, written after each
// change.
//   in     YAML: version, changed values of fuel and tyre gate, a list of alarms, a list of limits,
//          each with its author and reason
//   out    settings in force; the same as text
//   errors Problem with file, line and column: unknown keys, alarms or fields, numbers out of
//          range, a missing author. A file with one error changes nothing
//
//   version: 1
//   alarms:
//     - {alarm: fuel_last_attempt, priority: medium, limit: 0.5, deadband: 0, on_s: 0, off_s: 1,
//        author: A. Saba, reason: short track}
//   limits:
//     - {field: tyres.pressure_rear_left, warning_low: 150, author: A. Saba, reason: new tyres}
//   fuel: {attempt_laps: 2, home_laps: 1, reserve_l: 2, guess_l_per_lap: 2.2, spread: 0.13}
//   revision: 12                      counts the changes
//   radio: {up_kbit_s: 128}           as lowered by operators
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "basestation/alarms/evaluator.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::settings {

// Settings of the file; it has no course.
struct Judgement : alarms::EvaluatorConfig {
  std::uint64_t revision = 0;
  double up_kbit_s = kUnset;
};

Result<Judgement, Problem> read_judgement_file(const std::filesystem::path& path);
Result<Judgement, Problem> read_judgement_text(std::string_view text, const std::string& name);
std::string judgement_text(const state::DeriveParams& params, const alarms::Limits& limits,
                           const alarms::AlarmSettings& alarms, std::uint64_t revision = 0,
                           double up_kbit_s = kUnset);

}  // namespace pitwall::settings
