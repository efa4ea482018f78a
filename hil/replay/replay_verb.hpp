// `pitwall-hil replay FILE.log`: a recorded CAN log onto CAN interfaces, in real time.
//
//   replay FILE.log [--interface vcan0] [--map can0=vcan0]... [--speed X] [--loop N]
//          [--late catch-up|abort]
//
// Without --interface and --map every channel goes to the interface it was recorded from.
//   out    frames sent and lateness on standard output; exit code 0: every frame was sent; 1: some
//          were dropped, or the replay was aborted or stopped; 2: wrong usage, malformed log (said
//          with its place, nothing sent) or no such interface
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace pitwall::replay {

int replay_verb(std::span<const std::string> args);

}  // namespace pitwall::replay
