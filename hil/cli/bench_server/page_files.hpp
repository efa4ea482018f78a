// Pages of runs and sweeps, read piece by piece for clients that may be on another machine.
//   in     the folders of runs and of sweeps; name of a page, "sweeps/grip/report.html", and the
//          byte from which to read
//   out    the line `page` of PROTOCOL.md with the next part, at most kMaxPartBytes
//   invariants
//          nothing is read but .html files below the two folders: a name has no other characters
//          than letters, digits, "_", "-" and ".", no part of it begins with ".", and a symbolic
//          link that leads out of its folder is refused
//          no part ends inside a character of UTF-8
//   bound  kMaxPageBytes
//   errors Problem with the name as place: not a page's name, no such page, too large
//   cost   O(bytes of the page)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "hil/cli/bench_server/bench_request.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::bench_server {

// A byte takes at most six in JSON, so that a part with its names fits into a line.
inline constexpr std::size_t kMaxPartBytes = 40'000;

struct PageFolders {
  std::string runs, sweeps;
};

// Names of the pages of a run and of a sweep, by the name of its folder.
std::string page_of_run(std::string_view folder);
std::string page_of_sweep(std::string_view folder);

// Whether a client can ask for it now.
bool has_page(const PageFolders& folders, std::string_view page);

Result<std::string, Problem> page_line(const PageFolders& folders, const PageRequest& request);

}  // namespace pitwall::bench_server
