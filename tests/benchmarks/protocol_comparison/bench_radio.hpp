// Subcommand `pitwall-benchmarks radio [--seconds N] [--json FILE]`: comparison of our radio
// protocol with raw protobuf on UDP, LCM, Cyclone DDS and Fast DDS, by the age of the state that
// the operator sees and by the load on the radio.
// The link has 256 kbit/s, 15 ms, a queue of 16 kB (512 ms). Cases: light load; three times too
// much bulk (also with a queue of 256 and of 64 ms); bursty loss of 30 % (fades of 120 ms); both.
// The protocols run one at a time, with their real libraries, over the same fades. The others run
// with their defaults and once more tuned: bulk in pieces, paced to the part of 95 % of the rate
// that is left after the state, or Fast DDS's flow controller of that rate with state before bulk.
// A tuned protocol is configured with the rate and the sizes, ours with the rate only.
//   in     the peer programs: cmake --build ... --target radio_peers; root, for network namespaces
//   out    a table, ours first; the protocols whose age is at most 1.25 times ours; exit code 1 if
//          a gate is missed, 2 if it could not run
//   gates  only for ours: under overload without fades, safety 40 / 60 ms and all 100 signals 120 /
//          200 ms old (p50 / p99); in every case at most a tenth of the rate and one largest packet
//          in any 100 ms, at most the rate in any second
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace pitwall::benchmarks {

int bench_radio(std::span<const std::string> args);

}  // namespace pitwall::benchmarks
