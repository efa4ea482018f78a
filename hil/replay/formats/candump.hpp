// Reader of candump logs (can-utils) in every dialect, line by line:
//
//   (1398128223.803317) can0 166#D0320009          -l and -L: the log; 3 hex digits: standard id
//   (1398128223.803317123) can0 18DAF110#R8 T      9-digit stamp; remote; transmitted by the logger
//   (1398128223.803317) can0 123##1AABBCC          CAN FD: one digit of flags, then data
//   (2014-04-22 00:57:03.803317)  can0  166   [4]  D0 32 00 09        console, -tA
//   (000.000317)  can0  RX B E  123  [12]  11 22 ..  '.."'            console, -tz -x -a, CAN FD
//     can0  18DAF110   [0]  remote request                            console, no stamp
//
//   in     the whole text
//   out    CanLog. Small stamps of console output are offsets from the first frame (-tz) or, if
//          many decrease, gaps between frames (-td); a note says which. Local time of -tA is taken
//          as UTC, with a note
//   errors an unreadable line is left out; so is a last line without a line end, because its data
//          may be incomplete
//   source can-utils lib.c (sprint_canframe, sprint_long_canframe, parse_canframe), candump.c
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "hil/replay/formats/can_log.hpp"

namespace pitwall::replay {

inline constexpr std::string_view kCandumpName = "a candump log";

Result<CanLog, Problem> read_candump(std::string_view text, std::string_view file_name,
                                     const LogWatch& watch = {});
// True if the line looks like candump, even with damage in other parts of it.
bool looks_like_candump(std::string_view line);

}  // namespace pitwall::replay
