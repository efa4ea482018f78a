// Periodic timer of the live bench, with statistics of its lateness. A late wake-up is caught up at
// once and counted; no multiple is left out.
//   in     bench time, which is kept from here; none: the wall clock
//   out    RealTime: lateness of the wake-ups that were slept for, what bench time stood for, and
//          what the host took meanwhile
//   cost   one sleep per period; memory for every lateness is reserved at construction
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "hil/bench/live/bench_time.hpp"
#include "hil/bench/result.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::bench {

class WakeClock {
 public:
  WakeClock(Duration period, Duration longest, std::optional<BenchTime> time = {});

  void start();
  Instant started() const { return start_; }
  // Sleeps until `now` of the scenario, a multiple of the period.
  void sleep_until(Instant now);
  // No more wake-ups: time goes on by itself.
  void end();
  RealTime report();

 private:
  void wait_until(Instant deadline);
  void note(Duration behind, Instant now);

  Duration period_;
  Instant start_{}, wall_start_{};
  std::optional<BenchTime> time_;
  std::optional<Duration> stolen_at_start_;
  std::vector<float> late_us_;
  RealTime report_;
};

}  // namespace pitwall::bench
