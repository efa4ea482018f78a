// Cases of a sweep as rows of a table, with a link to the page of each that has one.
//   in     what the page of the sweep shows; the cases
//   out    HTML: number, verdict, least margin, why the case did not pass or whose margin is least,
//          values
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "hil/report/sweep/sweep_run.hpp"

namespace pitwall::report {

inline constexpr std::size_t kCasesShown = 10;

// The number, as a link where the case has a page.
std::string case_link(const SweepRun& run, std::size_t number);

// The first kCasesShown, in their order; the others are counted.
std::string case_table(const SweepRun& run, std::span<const sweep::CaseResult* const> cases);

}  // namespace pitwall::report
