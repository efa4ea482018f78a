// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/live/clock_place.hpp"

#include <unistd.h>

#include <string_view>

#include "hil/bench/live/virtual_machine.hpp"
#include "hil/can_bus/clock_message.hpp"
#include "protocol/transport/clock.hpp"

namespace pitwall::cli {

constexpr std::string_view kBenchClock = "bench", kOnHost = "host:";

ClockPlace clock_place(const std::string& clock, bool attached, bool in_guest) {
  if (clock == transport::kWallClock || (clock.empty() && attached)) return {};
  const bool hosts = clock.starts_with(kOnHost);
  if (is_clock_file(clock) && !(hosts && in_guest))
    return {.file = hosts ? clock.substr(kOnHost.size()) : clock, .line = {}, .is_own = false};
  return {.file = "/dev/shm/pitwall-clock-" + std::to_string(::getpid()),
          .line = hosts ? can_bus::kClockLine : "",
          .is_own = true};
}

ClockPlace clock_place(const std::string& clock, bool attached) {
  return clock_place(clock, attached, bench::is_guest());
}

bool is_clock_file(const std::string& clock) {
  return !clock.empty() && clock != kBenchClock && clock != transport::kWallClock;
}

std::string on_host(const std::string& clock) {
  return is_clock_file(clock) ? std::string{kOnHost} + clock : clock;
}

}  // namespace pitwall::cli
