// Writer of CAN logs in the format Vector BLF: containers compressed by zlib, CAN_MESSAGE and
// CAN_FD_MESSAGE, stamps in nanoseconds from the millisecond of the earliest frame.
//   in     frames; the number of each channel (1 and up)
//   out    bytes. An unknown direction is written as received
//   invariants
//          read_blf() reads the same frames
//   errors Problem if zlib has no memory
//   source python-can can/io/blf.py (BLFWriter)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "hil/replay/formats/can_log.hpp"

namespace pitwall::replay {

Result<std::string, Problem> to_blf(const CanLog& log, std::span<const unsigned> channel_numbers);

}  // namespace pitwall::replay
