// Report of a sweep as one HTML page that needs no network, in the style of the page of a run.
//   in     cases, results, the pages that single cases have; the results of an earlier sweep
//   out    the page: verdicts, worst cases, margins of each expectation, margin by parameter,
//          combinations of values that were run, difference to the earlier sweep
//   invariants
//          the same results give the same bytes: the page contains no time of day, no machine name
//          and no time that a run took
//   cost   O(results log results + results x parameters^2); a few hundred kB for any number of
//          results, as long as parameters and expectations are few
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "hil/report/sweep/sweep_run.hpp"

namespace pitwall::report {

std::string sweep_page(const SweepRun& run);

// Whether every case passed; with a baseline, whether none has become worse.
bool passed(const SweepRun& run);

// The cases that the page lists: those that did not pass, worst first; where all passed, those that
// are nearest to failing.
std::vector<const sweep::CaseResult*> worst_of(CaseResults results);

}  // namespace pitwall::report
