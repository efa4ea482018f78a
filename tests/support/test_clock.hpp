// Clock of a program that tests start: bench time if the test provides it (in_bench_time),
// otherwise the wall clock. Call it before any other thread starts.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdlib>

#include "protocol/transport/clock.hpp"

namespace pitwall::testing {

// False if the file of the bench clock cannot be used.
inline bool use_test_clock() {
  const char* const file = std::getenv("PITWALL_TEST_CLOCK");
  return file == nullptr || (transport::use_clock(file) && transport::take_turns());
}

}  // namespace pitwall::testing
