// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/live/timing_text.hpp"

#include "protocol/vocabulary/text.hpp"

namespace pitwall::cli {

std::string timing_text(const bench::LiveResult& live) {
  const bench::RealTime& time = *live.run.real_time;
  return formatted(
             "bench wake-up late by p50 %.0f us, p99 %.0f us, max %.0f us; %llu wake-ups caught "
             "up, at most %.0f ms behind; ",
             time.wake_late_p50_us, time.wake_late_p99_us, time.wake_late_max_us,
             static_cast<unsigned long long>(time.caught_up_wakes),
             time.behind_max.milliseconds()) +
         reports_text(live);
}

std::string reports_text(const bench::LiveResult& live) {
  return formatted(
      "%llu reports of the car; radio: %llu datagrams of the car, %llu arrived, %llu of the base, "
      "%llu arrived\n",
      static_cast<unsigned long long>(live.reports),
      static_cast<unsigned long long>(live.radio.from_car),
      static_cast<unsigned long long>(live.radio.to_base),
      static_cast<unsigned long long>(live.radio.from_base),
      static_cast<unsigned long long>(live.radio.to_car));
}

std::string waits_text(const bench::RealTime& time) {
  if (!time.waits) return "time by the wall clock\n";
  const transport::ClockWaits& waits = *time.waits;
  if (waits.count == 0 && waits.total.ns > 0) {
    return formatted("bench time, which another keeps, stood for %.2f s\n", waits.total.seconds());
  }
  std::string out = formatted("bench time stood %llu times for the machine, %.2f s in all",
                              static_cast<unsigned long long>(waits.count), waits.total.seconds());
  if (waits.count > 0) {
    out += formatted(", at the longest %.0f ms at %.2f s for %s", waits.longest.milliseconds(),
                     waits.longest_at.seconds(),
                     waits.longest_for.empty() ? "the bench" : waits.longest_for.c_str());
  }
  return out + "\n";
}

std::string stolen_text(const bench::RealTime& time) {
  if (!(time.stolen_ms > 0.0)) return {};
  return formatted("the host of this virtual machine took %.0f ms of its processors' time\n",
                   time.stolen_ms);
}

}  // namespace pitwall::cli
