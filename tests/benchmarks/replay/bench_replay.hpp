// `pitwall-benchmarks replay`: replay timing beside canplayer and python-can, on the same bus, from
// the same file, judged by the same recorder; and once more with the bytes of two receivers beside
// the frames, three passes without a seam. Where this kernel has no CAN, in a guest.
//
//   --log FILE      a candump log (default: sample_log.hpp, about 2,500 frames a second)
//   --length S      of the default log (10)         --runs N      of each player (3)
//   --interface     to play on (vcan0)              --json FILE   everything, for programs
//   out    a table: quantiles of lateness and gap error, medians over the runs; exit code 1 when a
//          gate is missed: ours complete and in order, at p50 at least 10 times closer to the
//          schedule than canplayer and 5 times than python-can (elsewhere 5 times and twice), with
//          and without sensors; frames and datagrams in one order; candump and ASC read at least
//          10 times as fast as by python-can; 2: it could not run
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace pitwall::benchmarks {

int bench_replay(std::span<const std::string> args);

}  // namespace pitwall::benchmarks
