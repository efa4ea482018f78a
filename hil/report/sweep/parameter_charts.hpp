// Margin of one expectation of a sweep against each numeric parameter, a dot a case.
//   in     cases and results; text of the expectation
//   out    HTML with a chart of each parameter that is a range or a list of different numbers. Of
//          more than kDotsMost cases so many are drawn: those that failed before those that passed,
//          and of each of both, where they are too many, evenly by number. A case that failed
//          without a finite margin stands at the lower edge
//   cost   O(results); 30 kB a chart
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include "hil/report/sweep/sweep_run.hpp"

namespace pitwall::report {

inline constexpr std::size_t kDotsMost = 2'000;

std::string parameter_charts(const sweep::Cases& cases, CaseResults results,
                             const std::string& expectation);

}  // namespace pitwall::report
