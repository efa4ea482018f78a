// Reader of Vector ASC logs (CANalyzer, CANoe, and tools that write the same).
//
//   date Sat Sep 30 15:06:13.191 2017                  once; English or German, 12 or 24 hours
//   base hex  timestamps absolute                      base of identifiers and data; or relative
//   Begin Triggerblock Sat Sep 30 15:06:13.191 2017    zero of the following stamps
//     2.501000 1  18EBFF00x       Rx d 8 01 A0 0F A6 60 3B D1 40  Length = 273910 BitCount = 141
//     2.520002 3  200             Tx r 8
//     2.530000 1  ErrorFrame
//    30.005071 CANFD   2 Rx        300  Name  1 0 8  8 01 02 03 04 05 06 07 08  102203 133 303000
//
//   in     the whole text; '.' or ',' before the fraction
//   out    CanLog; channel 1 is can0. Events other than frames are counted as other records. The
//          dates are local times of the recorder; they are taken as UTC, with a note
//   errors an unreadable line is left out; so is a last line without a line end
//   source python-can can/io/asc.py, T. Lorenz' Vector_ASC, the files of both projects' tests
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "hil/replay/formats/can_log.hpp"

namespace pitwall::replay {

inline constexpr std::string_view kAscName = "a Vector ASC log";

Result<CanLog, Problem> read_asc(std::string_view text, std::string_view file_name,
                                 const LogWatch& watch = {});
bool looks_like_asc(std::string_view line);

}  // namespace pitwall::replay
