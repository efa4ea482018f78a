// Periodic timer of the live bench, with statistics of its lateness. After a late wake-up the next
// ones follow at once until the timer is on time again; none is skipped, and the late ones are
// counted.
//   in     the bench time that this timer drives; nullopt: the wall clock
//   out    RealTime: lateness of the wake-ups that were slept for, pauses of bench time with their
//          causes, processor time stolen by the host
//   cost   one sleep per period; memory for all lateness values is reserved at construction
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

  // From here on bench time runs only while this clock sleeps, so that programs that start or end
  // on a slow machine lose none.
  void begin();
  void sleep_for(Duration span);
  void start();  // of the scenario
  void stop();   // its end
  Instant started() const { return start_; }
  // Sleeps until the scenario time `now`, a multiple of the period.
  void sleep_until(Instant now);
  // Ends the control of bench time: it then runs freely.
  void end();
  RealTime report();

 private:
  Instant wait_until(Instant deadline, Instant at);  // the time when it returns
  void note(Duration behind, Instant now);

  Duration period_;
  Instant start_{}, wall_start_{};
  std::optional<BenchTime> time_;
  std::optional<Duration> stolen_at_start_;
  std::vector<float> late_us_;
  RealTime report_;
};

}  // namespace pitwall::bench
