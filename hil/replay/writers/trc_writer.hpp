// Writer of CAN logs in the format PEAK TRC 2.1, with offsets from the millisecond of the earliest
// frame.
//   in     frames; the number of each channel (1 and up)
//   out    text with the line ends of PEAK's own programs; an offset of whole microseconds has 3
//          digits after the point, any other 6. An unknown direction is written as Rx
//   invariants
//          read_trc() reads the same frames
//   source PEAK-System, PCAN Trace File Format 2.1
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "hil/replay/formats/can_log.hpp"

namespace pitwall::replay {

std::string to_trc(const CanLog& log, std::span<const unsigned> channel_numbers);

}  // namespace pitwall::replay
