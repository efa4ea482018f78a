// Distribution of the margin of each expectation of a sweep, beside that of an earlier sweep.
//   in     what the page shows
//   out    HTML with a histogram of each expectation, those with most failures first; at most
//          kExpectationsShown, the others are counted
//   units  of a margin: those of its signal
//   cost   O(margins log margins); the size does not depend on the number of cases
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "hil/report/sweep/sweep_run.hpp"
#include "hil/sweep/margins.hpp"

namespace pitwall::report {

inline constexpr std::size_t kExpectationsShown = 40;

// Most failures first, then the least margin.
std::vector<sweep::MarginSpread> spreads_by_failures(CaseResults results);

std::string margin_charts(const SweepRun& run, const std::vector<sweep::MarginSpread>& spreads,
                          const std::vector<sweep::MarginSpread>& before);

// The spread of an expectation; nullptr where there is none.
const sweep::MarginSpread* spread_of(const std::vector<sweep::MarginSpread>& spreads,
                                     const std::string& expectation);

}  // namespace pitwall::report
