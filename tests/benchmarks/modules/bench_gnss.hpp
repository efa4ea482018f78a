// `pitwall-benchmarks gnss [--json FILE]`: what two satellite receivers cost the car.
//
//   in     a minute of two receivers at full rate, as their ports deliver it, byte for byte: the
//          NovAtel's BESTPOS and BESTVEL at 20 Hz, HEADING2 at 1 Hz, INSPVAX at 50 Hz, RAWIMUSX at
//          125 Hz, in binary and again in ASCII; the VN-310's outputs with the same values at the
//          same rates
//   out    a table: bytes and logs a second, the share of one core that finding, checking and
//          decoding them takes, and the share of the whole way to the car's samples
//   gates  the whole way at most 2 % of a core for each pair, every log decoded and every sample of
//          the IMU given on: exit code 1 where one is missed
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace pitwall::benchmarks {

int bench_gnss(std::span<const std::string> args);

}  // namespace pitwall::benchmarks
