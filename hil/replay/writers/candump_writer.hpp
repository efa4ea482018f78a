// Writer of CAN logs in the format of candump -l.
//   in     frames with the names of their channels
//   out    text: a stamp of whole microseconds has 6 digits, any other 9; a known direction is
//          written, an unknown one is left out
//   invariants
//          read_candump() reads the same frames
//   source can-utils lib.c sprint_canframe
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "hil/replay/formats/can_log.hpp"

namespace pitwall::replay {

// One line without the line end.
std::string to_candump_line(const LoggedFrame& frame, std::string_view channel);
std::string to_candump(const CanLog& log);

}  // namespace pitwall::replay
