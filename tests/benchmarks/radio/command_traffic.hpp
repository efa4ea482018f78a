// Load of operator commands and stops over a VirtualRadio, and a check of what the car does with
// each.
//   in     a radio; how many commands or stops
//   out    figures; the counts of errors are zero if the protocol is correct
//   units  true time
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tests/benchmarks/radio/virtual_radio.hpp"

namespace pitwall::radio {

struct CommandFigures {
  std::uint64_t issued = 0, applied = 0;
  std::uint64_t without_fate = 0;  // no outcome at the base, long after the last command
  std::uint64_t twice = 0;         // given to the car's consumer more than once
  std::uint64_t after_time = 0;    // given out after its time to live
  std::uint64_t out_of_order = 0;  // given out after a newer one of its type
  std::uint64_t fate_differs = 0;  // the base reports applied but the car did not, or the reverse
  std::vector<std::int64_t> to_apply_us;  // from the operator's press to the consumer, sorted

  double quantile_ms(double q) const;
};

// One command per `mean_gap` on average, all types in turn; after the last one the run waits half a
// minute for outcomes. With short gaps many commands are superseded: measure times with long ones.
CommandFigures run_commands(VirtualRadio& radio, std::uint64_t count, Duration mean_gap);

struct StopFigures {
  std::uint64_t trials = 0;
  std::uint64_t late = 0;          // not latched when the first packet after the press arrived
  std::uint64_t opened_alone = 0;  // the latch opened without a release
  std::uint64_t not_released = 0;  // a release at standstill had no effect within 10 s

  StopFigures& operator+=(const StopFigures& other);
};
// Needs a link with a delay of at most 18 ms that keeps the order.
StopFigures run_stops(VirtualRadio& radio, std::uint64_t trials);

}  // namespace pitwall::radio
