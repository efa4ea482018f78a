// Wall clock: CLOCK_MONOTONIC, also for a program that uses bench time; its reading and its sleep.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cerrno>
#include <ctime>

#include "protocol/vocabulary/check.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::transport {

inline Instant wall_now() {
  timespec t{};
  CHECK(clock_gettime(CLOCK_MONOTONIC, &t) == 0);
  return {t.tv_sec * kNanosecondsPerSecond + t.tv_nsec};
}

constexpr timespec to_timespec(Duration span) {
  return {.tv_sec = span.ns / kNanosecondsPerSecond, .tv_nsec = span.ns % kNanosecondsPerSecond};
}

// Sleeps by the wall clock, for a keeper of bench time, which would otherwise wait for itself.
inline void nap(Duration span) {
  if (span.ns <= 0) return;
  timespec left = to_timespec(span);
  while (true) {
    const int error = clock_nanosleep(CLOCK_MONOTONIC, 0, &left, &left);
    if (error == 0) return;
    CHECK(error == EINTR);
  }
}

}  // namespace pitwall::transport
