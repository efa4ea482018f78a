// Message about pauses of bench time: whether bench time is paused, and the total of all pauses.
//
//   paused   0 .. 150 ms          no message
//            from then on         every 100 ms of the wall clock
//            end of the pause     at once
//   running                       the total, once a second if it has changed
//
//   in     the pause of bench time, at each wake-up of the loop; bench time
//   out    the text `bench_time` if it is due; none in a base that runs by the wall clock
//   invariants
//          a stopped base process sends nothing; to its consoles it is unreachable
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "protocol/transport/bench_clock/bench_pause.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::publishers::console {

class PauseReport {
 public:
  static constexpr Duration kAgain = milliseconds(100);  // of the wall clock
  static constexpr Duration kTotalEvery = seconds(1), kTotalStep = milliseconds(10);

  std::optional<std::string> news(const std::optional<transport::BenchPause>& pause, Instant now);

 private:
  bool is_news(const transport::BenchPause& pause, Instant now) const;

  std::optional<transport::BenchPause> reported_;  // nullopt: nothing yet
  Instant reported_at_{};
};

}  // namespace pitwall::publishers::console
