// SPDX-License-Identifier: Apache-2.0
#include "protocol/ros/messages/std.hpp"

#include <gtest/gtest.h>

namespace pitwall::ros {
namespace {

TEST(RosTime, IsTheSecondAndTheRest) {
  const Time time = time_of(UtcTime{1'764'334'800'123'456'789});
  EXPECT_EQ(time.sec, 1'764'334'800);
  EXPECT_EQ(time.nanosec, 123'456'789U);
  EXPECT_EQ(time_of(UtcTime{2'000'000'000}).nanosec, 0U);
  EXPECT_EQ(time_of(UtcTime{1'999'999'999}).sec, 1);
}

}  // namespace
}  // namespace pitwall::ros
