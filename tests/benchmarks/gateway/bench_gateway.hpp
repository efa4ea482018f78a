// Benchmark `pitwall-benchmarks gateway [--seconds S] [--json FILE]`: the car's gateway under the
// traffic of three saturated buses (27,000 frames/s), on real SocketCAN; in a guest if the kernel
// of the host has no CAN.
//   load   every frame is sent. Gates: the car receives and reads every frame, no loss is reported
//   loss   a few hundred single frames are left out, the last one of the run too. Gates: each is
//          reported once, with its identifier, within 100 ms of its due time, and no other is
//          reported; by the car for its messages, by a receiver of all messages for all. A third
//          receiver with a small queue pauses; its loss count by the kernel is exact at the first
//          read
//   out    tables; exit code 1 if a gate is missed, 2 if the benchmark could not run
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace pitwall::benchmarks {

int bench_gateway(std::span<const std::string> args);

}  // namespace pitwall::benchmarks
