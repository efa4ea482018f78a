// Reader of the CAN frames of a file of any readable format. The file is memory-mapped; a progress
// line is shown.
//   in     a path; whether the user asked for progress
//   out    the log
//   errors Problem: no such file, not a log or recording, more frames than allowed in memory at
//          once
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "hil/replay/formats/can_log.hpp"

namespace pitwall::replay {

Result<CanLog, Problem> read_can_file(const std::string& path, bool shows_progress);

}  // namespace pitwall::replay
