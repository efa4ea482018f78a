// Assertion in every build: CHECK(condition) stops the process at a programming error; the watchdog
// of the drive-by-wire then stops the car. Never for input of networks, files, sensors or
// operators: that gets a Result.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <cstdlib>

namespace pitwall {

[[noreturn]] inline void check_failed(const char* condition, const char* file, int line) {
  std::fprintf(stderr, "%s:%d: CHECK failed: %s\n", file, line, condition);
  std::abort();
}

}  // namespace pitwall

#define CHECK(condition) \
  ((condition) ? static_cast<void>(0) : ::pitwall::check_failed(#condition, __FILE__, __LINE__))
