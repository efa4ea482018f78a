// Wall clock: CLOCK_MONOTONIC, also for a program that uses bench time.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ctime>

#include "protocol/vocabulary/check.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::transport {

inline Instant wall_now() {
  timespec t{};
  CHECK(clock_gettime(CLOCK_MONOTONIC, &t) == 0);
  return {t.tv_sec * kNanosecondsPerSecond + t.tv_nsec};
}

}  // namespace pitwall::transport
