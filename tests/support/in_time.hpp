// Bounds on wall-clock time, for tests that no other clock can judge: EXPECT_TRUE(in_time(...)).
//   in     what must hold on a machine that gives its processors when they are wanted
//   out    a failure that is about time alone. A program in which nothing else failed ends with
//          kOnlyLate, and is run again (tests/real_time/by_wall_clock.cpp)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include "protocol/vocabulary/time.hpp"

namespace pitwall::testing {

::testing::AssertionResult in_time(bool holds);
::testing::AssertionResult in_time(Duration took, Duration limit);

}  // namespace pitwall::testing
