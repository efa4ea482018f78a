// Synthetic CAN log for replay tests, without a car: the traffic of the race car's CAN bus, bit by
// bit on a wire of 1 Mbit/s, with the stamps of a recorder. The same on every machine.
//
//   drive-by-wire   reports at the period of the database, all of one tick back to back
//   computer        its eight commands every 10 ms, in one burst
//   calibration     a measurement tool's stream on 29-bit identifiers: 8 frames every 10 ms
//   stamps          end of frame plus the latency of an interrupt; whole microseconds
//
//   in     length of the log
//   out    about 2,500 frames a second, 32 % load; payloads are counters and noise, no physics
//   source protocol/can/dbc/av21.dbc for identifiers, lengths, periods; hil/can_bus for the wire
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hil/replay/formats/can_log.hpp"

namespace pitwall::replay {

CanLog sample_log(Duration length);

}  // namespace pitwall::replay
