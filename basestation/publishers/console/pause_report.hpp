// Message about bench time: whether it stands, and for how long it has stood in all.
//
//   stands   0 .. 150 ms          nothing
//            from then on         every 100 ms of the wall clock
//            is over              at once
//   goes on                       the total, once a second where it has changed
//
//   in     how bench time stands, at each wake-up of the loop; bench time
//   out    the text `bench_time`, where there is news; none by the wall clock
//   invariants
//          a base that is stopped tells nothing: to its consoles it does not answer
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

  std::optional<transport::BenchPause> reported_;  // none: nothing yet
  Instant reported_at_{};
};

}  // namespace pitwall::publishers::console
