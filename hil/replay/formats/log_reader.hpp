// The one way into the product for a CAN log of any format: recognised, unpacked, read.
//   in     the bytes of a file, whatever it is called
//   out    CanLog with its counters, remarks and notes
//   errors Problem that names what the file looks like and lists what is read, or the first place
//          that does not read where nothing does
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "hil/replay/formats/can_log.hpp"

namespace pitwall::replay {

Result<CanLog, Problem> read_can_log(std::string_view bytes, std::string_view file_name,
                                     const LogWatch& watch = {});

}  // namespace pitwall::replay
