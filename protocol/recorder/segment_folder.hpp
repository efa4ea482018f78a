// Segments of one folder: their list, and the repair of those that a killed base left.
//   in     a folder or files
//   out    paths in the order of their time; lines that describe the recovery
//   invariants
//          a file that another process is writing is not touched. A file is replaced as a whole,
//          and only by one with every message that can be read from it; if bytes in the middle were
//          damaged, the old file is kept as FILE.damaged
//   errors Problem with the path; one bad file does not stop the others
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "protocol/vocabulary/result.hpp"

namespace pitwall::recorder {

Result<std::vector<std::string>, Problem> segments_of(const std::string& folder);

// Returns a line for the log that says what was recovered.
Result<std::string, Problem> recover_file(const std::string& path);
// Recovers all segments without an end; one line each.
std::vector<std::string> recover_folder(const std::string& folder);

}  // namespace pitwall::recorder
