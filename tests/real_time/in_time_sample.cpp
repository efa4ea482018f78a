// What check_by_wall_clock runs: a bound on time that holds, one that fails, and a wrong value.
// SPDX-License-Identifier: Apache-2.0
#include "tests/support/in_time.hpp"

namespace pitwall::testing {
namespace {

TEST(InTimeSample, Holds) { EXPECT_TRUE(in_time(milliseconds(1), milliseconds(1))); }
TEST(InTimeSample, IsLate) { EXPECT_TRUE(in_time(milliseconds(2), milliseconds(1))) << "so"; }
TEST(InTimeSample, IsWrong) { EXPECT_EQ(1 + 1, 3); }

}  // namespace
}  // namespace pitwall::testing
