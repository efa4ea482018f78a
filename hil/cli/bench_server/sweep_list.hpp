// List of the sweeps in a folder, for clients of the bench server to see.
//   in     the folders of pages; in that of sweeps each sweep is a folder with summary.json and
//          report.html (hil/sweep/sweep_folder.hpp)
//   out    the line `sweeps` of PROTOCOL.md, in the order of the folders' names
//   bound  the first kMaxSweeps, of kMaxListBytes in all; a summary of more than kMaxSummaryBytes
//          is left out
//   errors none: a folder that does not exist has no sweeps; one without a summary is left out,
//          since its sweep has not ended
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include "hil/cli/bench_server/page_files.hpp"

namespace pitwall::bench_server {

inline constexpr std::size_t kMaxSweeps = 200, kMaxSummaryBytes = 600, kMaxListBytes = 200'000;

std::string sweeps_line(const PageFolders& folders);

}  // namespace pitwall::bench_server
