// SPDX-License-Identifier: Apache-2.0
#include "protocol/ros/messages/visualization.hpp"

#include <gtest/gtest.h>

#include "protocol/ros/cdr.hpp"
#include "protocol/ros/describe.hpp"

namespace pitwall::ros {
namespace {

// What every shape has although it is empty; lists and texts count themselves.
TEST(RosVisualization, AnEmptyMarkerHasTheSizeThatTheRulesGive) {
  std::vector<std::uint8_t> bytes;
  encode(MarkerArray{}, bytes);
  EXPECT_EQ(bytes, (std::vector<std::uint8_t>{0, 1, 0, 0, 0, 0, 0, 0}));
  bytes.clear();
  encode(Marker{}, bytes);
  const auto back = decode<Marker>(bytes);
  ASSERT_TRUE(back) << to_string(back.error());
  EXPECT_EQ(back->pose.orientation.w, 1.0) << "no turn, as the message files have it";
  // Header 8+4+1, up to 4: ns 4+1, up to 4: id, type, action; up to 8: pose 7, scale 3 doubles;
  // colour 4 floats, lifetime 8, frame_locked 1; up to 4: two counts ...
  const std::size_t pose = kCdrHeader + 16 + 8 + 12 + 4;
  EXPECT_EQ(bytes[pose + 6 * 8 + 7], 0x3F) << "w is 1";
  EXPECT_EQ(bytes[pose + 10 * 8 + 16 + 8], 0) << "not locked";
}

}  // namespace
}  // namespace pitwall::ros
