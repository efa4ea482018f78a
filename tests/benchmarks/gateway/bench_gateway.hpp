// `pitwall-benchmarks gateway [--seconds S] [--json FILE]`: the car's gateway under three saturated
// buses' worth of traffic (27,000 frames/s), on real SocketCAN; in a guest where this kernel has no
// CAN.
//   load   every frame is sent. Gates: the car receives and reads every one, no loss is reported
//   loss   a few hundred single frames are left out, the last of the run among them. Gates: each is
//          reported once with its identifier within 100 ms of when it was due, and no other; by the
//          car for its messages, by a receiver that knows all messages for all. A third receiver
//          with a small queue pauses: the kernel's count of what it lost is exact at the first look
//   out    tables; exit code 1 when a gate is missed, 2 when it could not run
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace pitwall::benchmarks {

int bench_gateway(std::span<const std::string> args);

}  // namespace pitwall::benchmarks
