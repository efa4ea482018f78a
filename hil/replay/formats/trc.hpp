// Reader of PEAK TRC logs (PCAN-View, PCAN-Explorer), versions 1.0, 1.1, 1.2, 1.3, 2.0 and 2.1.
//
//   ;$FILEVERSION=1.1                              missing: 1.0
//   ;$STARTTIME=44548.6028595139                   days since 1899-12-30
//   ;$COLUMNS=N,O,T,B,I,d,R,L,D                    of 2.x
//        1)      1841   0001 8  00 ..              1.0: offset in ms, identifier, length, data
//        1)     17535.4  Tx     00000100  8  00 .. 1.1: with the type; 8 digits: extended
//        1)     17535.400 1  Tx     00000100  8 .. 1.2: with the bus; 1.3: with a reserved column
//        1      17535.400 DT 1      0100 Rx -  8   2.x: DT, FD, FB, FE, BI, RR; others are events
//
//   in     the whole text
//   out    CanLog; bus 1 is can0. Warnings, errors and events are counted
//   errors an unreadable line is left out; so is a last line without a line end
//   source PEAK-System, PCAN Trace File Format; python-can can/io/trc.py
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "hil/replay/formats/can_log.hpp"

namespace pitwall::replay {

inline constexpr std::string_view kTrcName = "a PEAK TRC log";
inline constexpr std::int64_t kTrcDaysTo1970 = 25'569;  // from 1899-12-30, the day 0 of $STARTTIME

Result<CanLog, Problem> read_trc(std::string_view text, std::string_view file_name,
                                 const LogWatch& watch = {});
bool looks_like_trc(std::string_view line);

}  // namespace pitwall::replay
