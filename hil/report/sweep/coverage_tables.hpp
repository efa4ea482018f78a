// Which values of a sweep's parameters met: for every two parameters a table of their bins with how
// many cases were run there and how many of these did not pass.
//   in     cases and results of a sweep
//   out    HTML; parameters with one value are left out, and so are the pairs of parameters after
//          the first kPairsShown, which are counted
//   cost   O(results x parameters^2), 20 kB a table
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include "hil/report/sweep/sweep_run.hpp"

namespace pitwall::report {

inline constexpr std::size_t kPairsShown = 120;  // of 16 parameters

std::string coverage_tables(const sweep::Cases& cases, CaseResults results);

}  // namespace pitwall::report
