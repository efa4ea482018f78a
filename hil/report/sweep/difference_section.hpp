// What another build made of the cases of an earlier sweep: cases whose verdict changed, and by how
// much the margin of each expectation did.
//   in     what the page shows, with a baseline; the margins of both
//   out    HTML
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "hil/report/sweep/sweep_run.hpp"
#include "hil/sweep/margins.hpp"

namespace pitwall::report {

std::string difference_section(const SweepRun& run, const std::vector<sweep::MarginSpread>& now,
                               const std::vector<sweep::MarginSpread>& before);

}  // namespace pitwall::report
