// `pitwall-benchmarks radio [--seconds N] [--json FILE]`: our radio protocol beside raw protobuf on
// UDP, LCM, Cyclone DDS and Fast DDS: age of the state that the operator sees, and what each puts
// on the air. 256 kbit/s, 15 ms, a queue of 16 kB (512 ms); light load, three times too much bulk
// (also with a queue of 256 and of 64 ms), bursty loss of 30 % (fades of 120 ms), and both. One at
// a time, real libraries, the same fades. The others run with their defaults, and once more tuned:
// bulk in pieces paced to what state leaves of 95 % of the rate, or Fast DDS's flow controller of
// that rate with state before bulk. A tuned one knows rate and sizes beforehand; ours knows the
// rate.
//   in     the contestants' programs: cmake --build ... --target radio_peers; root for networks of
//          their own
//   out    a table, ours first; who comes near ours; exit code 1 where a gate is missed, 2 where it
//          could not run
//   gates  of ours: under overload safety 40 / 60 ms, all 100 signals 120 / 200 ms old (p50 / p99);
//          in every case at most a tenth of the rate and one largest packet in any 100 ms, at most
//          the rate in any second
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace pitwall::benchmarks {

int bench_radio(std::span<const std::string> args);

}  // namespace pitwall::benchmarks
