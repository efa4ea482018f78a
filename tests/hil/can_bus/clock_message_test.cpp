// SPDX-License-Identifier: Apache-2.0
#include "hil/can_bus/clock_message.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace pitwall::can_bus {
namespace {

TEST(ClockMessage, HoldsEveryInstantLowestByteFirst) {
  for (const std::int64_t ns : {0L, 1L, -1L, 123'456'789'012L, INT64_MAX, INT64_MIN})
    EXPECT_EQ(decode_clock(encode_clock(Instant{ns})), Instant{ns});
  EXPECT_EQ(encode_clock(Instant{0x0102}), (ClockMessage{2, 1, 0, 0, 0, 0, 0, 0}));
}

TEST(ClockMessage, IsNothingAtAnotherLength) {
  for (const std::size_t bytes : {0U, 7U, 9U})
    EXPECT_EQ(decode_clock(std::vector<std::uint8_t>(bytes)), std::nullopt) << bytes;
}

}  // namespace
}  // namespace pitwall::can_bus
