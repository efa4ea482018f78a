// Reader of CAN logs of any format: recognises, decompresses and reads. The only entry for logs.
//   in     the bytes of a file; its name has no influence on the format
//   out    CanLog with its counters, remarks and notes
//   errors Problem with the apparent format and the list of readable formats, or with the first
//          unreadable place if nothing is readable
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "hil/replay/formats/can_log.hpp"

namespace pitwall::replay {

Result<CanLog, Problem> read_can_log(std::string_view bytes, std::string_view file_name,
                                     const LogWatch& watch = {});

}  // namespace pitwall::replay
