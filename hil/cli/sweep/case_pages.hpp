// Pages of single cases of a sweep: each of them is run again, with its report, in a process.
//   in     cases with their results; the folder of the pages; the sweep as a command; how many
//          processes at a time
//   out    pages/NUMBER in the folder of the sweep, as `--case NUMBER --report` makes it; the
//          addresses of the pages beside that of the sweep. A page of the same run that is there
//          already is not made again; a case that was refused or crashed has none
//   law    a run has the event log that its digest in the sweep names
//   errors Problem if a process cannot be started, leaves no result, or made another event log: the
//          sweep was run by another build
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "hil/sweep/case_result.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::cli {

struct PagesPlan {
  std::string folder;                // pages/ of the sweep
  std::vector<std::string> command;  // `pitwall-hil sweep PLAN`
  unsigned processes = 1;            // at a time
};

using CasePages = std::map<std::size_t, std::string>;

Result<CasePages, Problem> make_case_pages(const std::vector<const sweep::CaseResult*>& cases,
                                           const PagesPlan& plan);

}  // namespace pitwall::cli
