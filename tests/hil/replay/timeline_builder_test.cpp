// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/timeline_builder.hpp"

#include <gtest/gtest.h>

namespace pitwall::replay {
namespace {

constexpr UtcTime kBegin{kNanosecondsPerSecond};
UtcTime after(Duration d) { return {kBegin.ns + d.ns}; }

TEST(TimelineBuilder, BytesOfARecordAreCutIntoDatagramsThatAreDueTogether) {
  TimelineBuilder builder{"recording", kBegin, {}};
  const std::size_t track = builder.bytes(UdpAddress{.port = 3'001});
  std::vector<std::uint8_t> bytes(2 * transport::kMaxDatagramBytes + 1);
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::uint8_t>(i * 7);
  builder.add(track, kBegin, std::vector<std::uint8_t>{9});
  builder.add(track, after(milliseconds(1)), std::vector<std::uint8_t>{});  // nothing to send
  builder.add(track, after(milliseconds(2)), bytes);
  const auto t = std::move(builder).finish();
  ASSERT_TRUE(t.has_value());
  EXPECT_EQ(t->datagrams, 4U);
  const Track& made = t->tracks[0];
  EXPECT_EQ(made.due,
            (std::vector<Duration>{{}, milliseconds(2), milliseconds(2), milliseconds(2)}));
  std::vector<std::uint8_t> again;
  for (std::size_t i = 1; i < 4; ++i)
    again.insert(again.end(), made.datagrams[i].begin(), made.datagrams[i].end());
  EXPECT_EQ(again, bytes);
  EXPECT_EQ(made.datagrams[3].size(), 1U);
}

TEST(TimelineBuilder, AnInterfaceHasOneTrackAndAReceiverItsOwnAndEmptyOnesAreNotThere) {
  TimelineBuilder builder{"recording", kBegin, {}};
  const std::size_t first = builder.bus("v0");
  const std::size_t empty = builder.bytes(UdpAddress{.port = 1});
  EXPECT_EQ(builder.bus("v0"), first);
  EXPECT_NE(empty, first);
  const std::size_t other = builder.bus("v1");
  builder.add(other, kBegin, can::Frame{}, 0);
  builder.add(first, after(milliseconds(3)), can::Frame{}, kFdBitRateSwitch);
  const auto t = std::move(builder).finish();
  ASSERT_TRUE(t.has_value());
  ASSERT_EQ(t->tracks.size(), 2U);
  EXPECT_EQ(t->tracks[0].target, "v0");
  EXPECT_EQ(t->tracks[0].due[0], milliseconds(3));
  EXPECT_EQ(t->tracks[0].fd_flags[0], kFdBitRateSwitch);
  EXPECT_EQ(t->pass, milliseconds(6));
}

TEST(TimelineBuilder, NothingToPlaySaysWhatWasLeftOutAndTooLongSaysSo) {
  TimelineBuilder none{"recording", kBegin, {}};
  none.leave_out({"/imu", "has no way", 3});
  const auto nothing = std::move(none).finish();
  ASSERT_FALSE(nothing.has_value());
  EXPECT_EQ(nothing.error().what, "nothing is left of it to play; /imu: has no way");
  TimelineBuilder builder{"recording", kBegin, {}};
  const std::size_t track = builder.bytes(UdpAddress{.port = 1});
  builder.add(track, kBegin, std::vector<std::uint8_t>{1});
  builder.add(track, after(seconds(400LL * 24 * 3'600)), std::vector<std::uint8_t>{1});
  const auto slow = std::move(builder).finish();
  ASSERT_FALSE(slow.has_value());
  EXPECT_NE(slow.error().what.find("more than a year"), std::string::npos);
}

}  // namespace
}  // namespace pitwall::replay
