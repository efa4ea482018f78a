// A CAN log as candump -l writes it.
//   in     frames with the names of their channels
//   out    text: a stamp of whole microseconds has 6 digits, any other 9; a direction that is known
//          is said
//   invariants
//          read_candump() reads the same frames
//   source can-utils lib.c sprint_canframe
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "hil/replay/formats/can_log.hpp"

namespace pitwall::replay {

// One line without its end.
std::string to_candump_line(const LoggedFrame& frame, std::string_view channel);
std::string to_candump(const CanLog& log);

}  // namespace pitwall::replay
