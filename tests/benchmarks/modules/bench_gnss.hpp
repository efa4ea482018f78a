// Subcommand `pitwall-benchmarks gnss [--json FILE]`: processor time of decoding two satellite
// receivers.
//
//   in     one minute of two receivers at full rate, as their ports deliver it, byte for byte: the
//          NovAtel's BESTPOS and BESTVEL at 20 Hz, HEADING2 at 1 Hz, INSPVAX at 50 Hz, RAWIMUSX at
//          125 Hz, in binary and again in ASCII; the VN-310's outputs with the same values at the
//          same rates
//   out    a table: bytes and logs per second, the share of one core for finding, checking and
//          decoding them, and the share for the whole path to the car's samples
//   gates  the whole path takes at most 2 % of a core for each pair, every log is decoded and every
//          sample of the IMU is passed on; exit code 1 if one is missed
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace pitwall::benchmarks {

int bench_gnss(std::span<const std::string> args);

}  // namespace pitwall::benchmarks
