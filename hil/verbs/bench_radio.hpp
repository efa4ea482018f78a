// `pitwall-hil bench radio [--seconds N] [--json FILE]`: our radio protocol beside raw protobuf on
// UDP, LCM, Cyclone DDS and Fast DDS: how old the state is that the operator sees, and what each
// puts on the air. 256 kbit/s, a queue of 16 kB, 15 ms; light load, three times too much, bursty
// loss of 30 % (fades of 120 ms), and both. One at a time, real libraries, the same fades.
//   in     the contestants' programs: cmake --build ... --target radio_peers; root for networks of
//          their own
//   out    a table, ours first; exit code 1 where ours is older than 40 ms (p50) or 60 ms (p99)
//          under overload, or offers more than the link carries; 2 where it could not run
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace pitwall::verbs {

int bench_radio(std::span<const std::string> args);

}  // namespace pitwall::verbs
