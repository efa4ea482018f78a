// Subcommand `pitwall-benchmarks replay`: comparison of our replay timing with canplayer and
// python-can, on the same bus, from the same file, measured by the same recorder; and once more
// ours with the bytes of two receivers beside the frames, in three passes without a gap. It runs in
// a guest if this kernel has no CAN.
//
//   --log FILE      a candump log (default: sample_log.hpp, about 2,500 frames a second)
//   --length S      of the default log (10)         --runs N      of each player (3)
//   --interface     to play on (vcan0)              --json FILE   everything, for programs
//   out    a table: quantiles of lateness and gap error, medians over the runs; exit code 1 if a
//          gate is missed; 2 if it could not run
//   gates  ours complete and in order; the p50 of its lateness at least 10 times smaller than that
//          of canplayer and 5 times than that of python-can (other figures 5 times and twice), with
//          and without sensors; frames and datagrams in one order; candump and ASC read at least 10
//          times as fast as by python-can
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

namespace pitwall::benchmarks {

int bench_replay(std::span<const std::string> args);

}  // namespace pitwall::benchmarks
