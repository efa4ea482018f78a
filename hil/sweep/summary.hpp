// Summary of a sweep as text: verdicts, the margins of each expectation, the worst cases.
//   in     cases, results by number; the command that runs one case again, without its number
//   out    least margin, that of one case in twenty, the middle one; at most `kWorstShown` cases
//          with their values, worst margin of a failed expectation first
//   units  of a margin: those of its signal
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "hil/sweep/case_result.hpp"
#include "hil/sweep/cases.hpp"

namespace pitwall::sweep {

inline constexpr std::size_t kWorstShown = 5;

std::string summary_of(const Cases& cases, std::span<const CaseResult> results,
                       const std::string& one_case);

// "197 passed, 3 failed, ...": how many of each verdict.
std::string verdicts_text(std::span<const CaseResult> results);

// The same in short, for programs: name, scenario, cases and how many of each verdict.
std::string summary_json(const Plan& plan, std::span<const CaseResult> results);

// Whether every case passed.
bool all_passed(std::span<const CaseResult> results);

}  // namespace pitwall::sweep
