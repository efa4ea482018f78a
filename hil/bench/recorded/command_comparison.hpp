// Modes and commands of a run that was played to a live car, against those of the recording.
//   in     both traces; tolerances
//   out    what differs, signal by signal, as Comparison has it: how often, where first, where most
//   units  those of the CAN database; times since the first tick of each run
//   invariants
//          a live car cannot repeat a run to the bit: nobody holds its ticks to those of the
//          recording. Two things may differ, and the tolerances are made of them and of nothing
//          that was measured:
//            when   a frame that came just before a tick may come just after it, and the first
//                   ticks of both runs are brought together to one tick: two ticks. What just
//                   misses one plan is acted on with the next, so commands may follow a planning
//                   period later (command_lag): shown in lockstep, where inputs alone are moved
//                   (tests/hil/bench/recorded/moved_inputs_test.cpp)
//            how    of inputs that are one tick newer or older, a command is another one by what
//                   its slew limit lets it change in a tick, and by one step of its signal
//          a command is compared with the nearest value of the other run within command_lag. The
//          gear has no tolerance of its own. Modes follow each other in the same order, each within
//          two ticks and one recorded state of the other run's
//          commands that only one run has are a difference
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hil/bench/recorded/command_trace.hpp"
#include "hil/bench/recorded/comparison.hpp"
#include "vehicle/pipeline/setup.hpp"

namespace pitwall::bench {

struct CommandTolerances {
  static constexpr std::int64_t kLagTicks = 2;

  Duration tick{}, planning{};  // periods
  std::array<double, kActuators> command{};

  Duration lag() const { return tick * kLagTicks; }
  Duration command_lag() const { return lag() + planning; }
  Duration mode_lag() const;
};
CommandTolerances tolerances_of(const pipeline::CarParams& params, const can::Database& database);

struct CommandComparison {
  std::vector<SignalDifference> differences;
  std::uint64_t commands = 0, modes = 0;  // compared
  Duration compared{};                    // of the run, from its first tick
};
CommandComparison compare(const CommandTrace& recorded, const CommandTrace& again,
                          const CommandTolerances& tolerances);

}  // namespace pitwall::bench
