// The CAN frames of a file of any format that is read: mapped, with a line of progress.
//   in     a path; whether progress was asked for
//   out    the log
//   errors Problem: no such file, no log or recording, more frames than fit into memory at once
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "hil/replay/formats/can_log.hpp"

namespace pitwall::replay {

Result<CanLog, Problem> read_can_file(const std::string& path, bool shows_progress);

}  // namespace pitwall::replay
