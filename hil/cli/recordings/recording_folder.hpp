// Reader of a recording: one file, or a folder of segments as one recording.
//   in     a file of any format that read_recording() reads, or the folder of a black box
//   errors Problem with the file
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "hil/replay/recordings/recording.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::cli {

Result<traffic::Recording, Problem> read_traffic(const std::string& path);

}  // namespace pitwall::cli
