// Change of one signal of a report, and nothing else of the frame.
//   in     a frame; which of the signals of its message that the bench can change, from 0; the
//          value
//   out    the frame
//   units  those of the database (km/h, kPa, %, deg; raw for sys_state)
//   invariants
//          a value beyond what the field holds becomes the field's end; a frame of another message
//          is left as it is
//   source protocol/can/dbc/av21.dbc
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "protocol/can/frame.hpp"

namespace pitwall::faults {

bool has_signal(std::uint32_t id, std::uint32_t unit);
void add_to_signal(can::Frame& frame, std::uint8_t unit, double value);
void set_signal(can::Frame& frame, std::uint8_t unit, double value);

}  // namespace pitwall::faults
