// The segments of a folder: which there are, and those that a killed base left made whole.
//   in     a folder or files
//   out    paths in the order of their time; lines that tell what was recovered
//   invariants
//          a file that another process writes is left alone. A file is replaced as a whole, and
//          only by one that holds every message that can be read of it; where bytes in its middle
//          were damaged, the old file stays beside it as FILE.damaged
//   errors Problem with the path; one bad file does not stop the others
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "protocol/vocabulary/result.hpp"

namespace pitwall::recorder {

Result<std::vector<std::string>, Problem> segments_of(const std::string& folder);

// What became of it, for a person.
Result<std::string, Problem> recover_file(const std::string& path);
// Of all segments that have no end; a line for each.
std::vector<std::string> recover_folder(const std::string& folder);

}  // namespace pitwall::recorder
