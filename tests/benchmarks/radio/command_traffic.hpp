// An operator who gives commands and stops without pause over a VirtualRadio, and an onlooker who
// knows what the car did with each.
//   in     a radio; how many
//   out    figures; the counts of what must not happen are zero where the protocol keeps its word
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
  std::uint64_t without_fate = 0;  // at the base, long after the last one
  std::uint64_t twice = 0;         // handed to the car's consumer more than once
  std::uint64_t after_time = 0;    // handed out after its time to live
  std::uint64_t out_of_order = 0;  // handed out after a newer one of its type
  std::uint64_t fate_differs = 0;  // the base says applied where the car did not, or the reverse
  std::vector<std::int64_t> to_apply_us;  // from the operator's press to the consumer, sorted

  double quantile_ms(double q) const;
};

// One command each `mean_gap` in the mean, all types in turn; half a minute after the last one is
// waited for fates. Short gaps make many that are superseded: for times take long ones.
CommandFigures run_commands(VirtualRadio& radio, std::uint64_t count, Duration mean_gap);

struct StopFigures {
  std::uint64_t trials = 0;
  std::uint64_t late = 0;          // not latched when the first packet after the press arrived
  std::uint64_t opened_alone = 0;  // latch open without a release
  std::uint64_t not_released = 0;  // a release at standstill had no effect within 10 s

  StopFigures& operator+=(const StopFigures& other);
};
// Over a link of at most 18 ms that keeps the order.
StopFigures run_stops(VirtualRadio& radio, std::uint64_t trials);

}  // namespace pitwall::radio
