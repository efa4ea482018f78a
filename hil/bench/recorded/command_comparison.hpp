// Comparison of the modes and commands of a live replay with those of the recording.
//   in     both traces; tolerances
//   out    the differences by signal, as in Comparison: how often, the first, the largest
//   units  those of the CAN database; times since the first tick of each run
//   invariants
//          a live car does not repeat a run to the bit, because its ticks are not tied to those of
//          the recording. Two things may differ, and the tolerances follow from them alone, not
//          from measurements:
//            time    a frame that came just before a tick may come just after it, and the first
//                    ticks of both runs are aligned to one tick only: two ticks. An input that just
//                    misses one plan takes effect with the next one, so commands may follow one
//                    planning period later (command_lag): shown in lockstep, where only the inputs
//                    are moved (tests/hil/bench/recorded/moved_inputs_test.cpp)
//            value   with inputs one tick newer or older, a command differs by what its slew limit
//                    allows in one tick, plus one step of its signal
//          a command is compared with the nearest value of the other run within command_lag. The
//          gear has no tolerance of its own. Modes follow in the same order; each mode change is
//          within two ticks plus the interval of recorded states of that in the other run
//          (mode_lag). A mode that ends within mode_lag is not compared: where two causes come
//          together, as standstill and the loss of all inputs, one run may pass through a mode
//          that the other never had
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
  std::uint64_t commands = 0, modes = 0;  // number compared
  Duration compared{};                    // compared part of the run, from its first tick
};
CommandComparison compare(const CommandTrace& recorded, const CommandTrace& again,
                          const CommandTolerances& tolerances);

}  // namespace pitwall::bench
