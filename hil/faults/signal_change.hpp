// Change of one signal in a CAN report frame; the rest of the frame stays.
//   in     a frame; the index of the signal among those of its message that the bench can change;
//          the value
//   out    the changed frame
//   units  those of the database (km/h, kPa, %, deg; raw for sys_state)
//   invariants
//          a value outside the range of the field is clamped to the end of the range; a frame of
//          another message is not changed
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
