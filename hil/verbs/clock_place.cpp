// SPDX-License-Identifier: Apache-2.0
#include "hil/verbs/clock_place.hpp"

#include <unistd.h>

#include "hil/bench/machine.hpp"
#include "hil/guest/clock_word.hpp"
#include "protocol/transport/clock.hpp"

namespace pitwall::verbs {

constexpr const char* kBenchClock = "bench";

ClockPlace clock_place(const std::string& clock, bool attached, bool in_guest) {
  if (clock == transport::kWallClock || (clock.empty() && attached)) return {};
  const bool shared = is_clock_file(clock);
  if (shared && !in_guest) return {.file = clock, .line = {}, .is_own = false};
  return {.file = "/dev/shm/pitwall-clock-" + std::to_string(::getpid()),
          .line = shared ? guest::kClockLine : "",
          .is_own = true};
}

ClockPlace clock_place(const std::string& clock, bool attached) {
  return clock_place(clock, attached, bench::is_guest());
}

bool is_clock_file(const std::string& clock) {
  return !clock.empty() && clock != kBenchClock && clock != transport::kWallClock;
}

}  // namespace pitwall::verbs
