// SPDX-License-Identifier: Apache-2.0
#include "protocol/ros/messages/radar.hpp"

#include <gtest/gtest.h>

#include "protocol/ros/cdr.hpp"

namespace pitwall::ros {
namespace {

// Counted by hand: stamp, a frame of "radar" with its NUL up to 4, the count, five floats.
TEST(RosRadar, AReturnLiesWhereTheRulesOfCdrPutIt) {
  RadarScan scan;
  scan.header.frame_id = "radar";
  scan.returns.push_back({.range = 1.0F, .doppler_velocity = -2.0F, .amplitude = 4.0F});
  std::vector<std::uint8_t> bytes;
  encode(scan, bytes);
  const std::size_t range = kCdrHeader + 8 + 4 + 8 + 4;
  ASSERT_EQ(bytes.size(), range + 5 * 4);
  EXPECT_EQ(bytes[range - 4], 1);
  EXPECT_EQ(bytes[range + 3], 0x3F);
  EXPECT_EQ(bytes[range + 12 + 3], 0xC0);
  EXPECT_EQ(bytes[range + 16 + 3], 0x40);
}

}  // namespace
}  // namespace pitwall::ros
