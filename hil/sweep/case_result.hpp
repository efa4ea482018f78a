// What became of one case of a sweep, as a line of text: each process of a sweep appends its own to
// a file, so that nothing that has ended is lost when a process, or the machine, dies.
//   format a JSON object a line; `wall_s` is the only figure that differs from run to run
//   errors parse(): nullopt for a line that is cut short or is none
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/vocabulary/units.hpp"

namespace pitwall::sweep {

enum class CaseVerdict : std::uint8_t {
  kPassed,
  kFailed,   // an expectation
  kContact,  // with a wall, unexpected
  kRefused,  // the bench does not take these values
  kCrashed,  // the process of the case ended, twice
};
inline constexpr std::size_t kCaseVerdicts = 5;

const char* name_of(CaseVerdict verdict);

struct ExpectationMargin {
  std::string text;        // of the expectation
  double margin = kUnset;  // not finite where it never came to be judged
  bool pass = false;
};

struct CaseResult {
  std::size_t number = 0;
  CaseVerdict verdict = CaseVerdict::kCrashed;
  std::string why{};     // of a refusal or a crash
  std::string digest{};  // SHA-256 of the event log
  double simulated_s = 0.0, wall_s = 0.0;
  std::vector<ExpectationMargin> margins{};
};

// The one of that number, which is among them; `results` in order.
const CaseResult& result_of(std::span<const CaseResult> results, std::size_t number);

std::string to_line(const CaseResult& result);  // without the end of the line
std::optional<CaseResult> parse_case_result(std::string_view line);

}  // namespace pitwall::sweep
