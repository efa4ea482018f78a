// Bounds on wall-clock time, for properties that no other clock measures:
// EXPECT_TRUE(in_time(...)).
//   in     a condition that holds on a machine whose processors are free when needed
//   out    a failure marked as a matter of time. A program whose only failures are marked so exits
//          with kOnlyLate and is run again (tests/real_time/by_wall_clock.cpp)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include "protocol/vocabulary/time.hpp"

namespace pitwall::testing {

::testing::AssertionResult in_time(bool holds);
::testing::AssertionResult in_time(Duration took, Duration limit);

}  // namespace pitwall::testing
