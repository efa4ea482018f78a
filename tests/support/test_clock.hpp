// The clock of a program that tests start: bench time where the test keeps one (in_bench_time),
// else the wall's. Before any other thread starts.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdlib>

#include "protocol/transport/clock.hpp"

namespace pitwall::testing {

// False: the file of that time cannot be used.
inline bool use_test_clock() {
  const char* const file = std::getenv("PITWALL_TEST_CLOCK");
  return file == nullptr || (transport::use_clock(file) && transport::take_turns());
}

}  // namespace pitwall::testing
