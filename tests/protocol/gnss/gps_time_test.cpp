// SPDX-License-Identifier: Apache-2.0
#include "protocol/gnss/gps_time.hpp"

#include <gtest/gtest.h>

namespace pitwall::gnss {
namespace {

TEST(GpsTime, SplitsIntoWeekAndTimeOfWeekAndBack) {
  for (const std::uint16_t w : {std::uint16_t{0}, std::uint16_t{2090}, std::uint16_t{4096}}) {
    for (const std::int64_t ms :
         {std::int64_t{0}, std::int64_t{1}, std::int64_t{408'227'000}, kWeek_ms - 1}) {
      const GpsTime t = gps_time(w, milliseconds(ms));
      EXPECT_EQ(week(t), w);
      EXPECT_EQ(of_week(t), milliseconds(ms));
    }
  }
}

TEST(GpsTime, TheNextWeekFollowsTheLastMillisecond) {
  EXPECT_EQ(gps_time(101, {}) - gps_time(100, milliseconds(kWeek_ms - 1)), milliseconds(1));
}

TEST(GpsTime, AWeekThatNoReceiverCanMeanIsNoneAndStaysWithinTheType) {
  EXPECT_FALSE(is_week(0));
  EXPECT_TRUE(is_week(1) && is_week(kMaxWeek));
  EXPECT_FALSE(is_week(kMaxWeek + 1));
  EXPECT_EQ(week(gps_time(65'535, milliseconds(kWeek_ms - 1))), kMaxWeek);
}

}  // namespace
}  // namespace pitwall::gnss
