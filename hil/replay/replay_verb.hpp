// `pitwall-hil replay FILE`: a recorded CAN log of any format onto CAN interfaces, in real time.
//
//   replay FILE [--interface vcan0] [--map can0=vcan0]... [--speed X] [--loop N]
//          [--start S] [--skip S] [--id HEX]...
//          [--late catch-up|drop:MS|abort:MS] [--spin US] [--json FILE]
//
// Without --interface and --map every channel goes to the interface it was recorded from.
//   --start    leaves out the first seconds of the log; --id everything but these identifiers
//   --skip     seconds: does not wait through longer gaps
//   --late     what becomes of a frame that is later than that many milliseconds (default catch-up:
//              it is sent at once)
//   --spin     wakes up so many microseconds early and waits busily for the rest, 0 to 200; takes
//              that time from other programs of the processor. Default: what sleeps are usually
//              late on this machine, measured at the start
//   out    frames sent, lateness, what was dropped and which real-time rights the kernel granted,
//          on standard output; exit code 0: every frame was sent; 1: some were dropped, or the
//          replay was aborted or stopped; 2: wrong usage, a file that is no CAN log, or no
//          such interface. Records that do not read are told with their places, on standard error
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace pitwall::replay {

int replay_verb(std::span<const std::string> args);

}  // namespace pitwall::replay
