// Writer of CAN logs in the format Vector ASC, hexadecimal, with absolute stamps from the
// millisecond of the earliest frame.
//   in     frames; the number of each channel (1 and up)
//   out    text; a stamp of whole microseconds has 6 digits, any other 9. An unknown direction is
//          written as Rx
//   invariants
//          read_asc() reads the same frames
//   source python-can can/io/asc.py (ASCWriter)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "hil/replay/formats/can_log.hpp"

namespace pitwall::replay {

std::string to_asc(const CanLog& log, std::span<const unsigned> channel_numbers);

}  // namespace pitwall::replay
