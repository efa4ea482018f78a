// CHECK(condition): our own mistakes stop the process, in every build; the drive-by-wire's own
// watchdog then stops the car. Never for bytes, files, sensors or operators: those get a Result.
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
