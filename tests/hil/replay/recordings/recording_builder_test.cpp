// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/recordings/recording_builder.hpp"

#include <gtest/gtest.h>

#include "tests/hil/replay/recordings/recording_samples.hpp"

namespace pitwall::traffic {
namespace {

TEST(RecordingBuilder, SortsByStampAndTellsOfEachThatWentBack) {
  RecordingBuilder builder{"a.log"};
  const auto can0 = builder.add_source("can0", SourceKind::kCan, "can");
  const auto can1 = builder.add_source("can1", SourceKind::kCan, "can");
  for (const std::int64_t ns : {50, 30, 40, 40, 60}) {
    EXPECT_TRUE(builder.add(can1, UtcTime{ns}, testing::some_frame(1), 0));
    EXPECT_TRUE(builder.add(can0, UtcTime{ns}, testing::some_frame(2), 0));
  }
  const Recording recording = std::move(builder).finish();
  testing::expect_sound(recording);
  ASSERT_EQ(recording.records.size(), 10U);
  EXPECT_EQ(recording.first(), UtcTime{30});
  EXPECT_EQ(recording.last(), UtcTime{60});
  const std::vector<std::uint64_t> sequences{1, 1, 2, 3, 2, 3, 0, 0, 4, 4};
  const std::vector<std::uint32_t> sources{0, 1, 0, 0, 1, 1, 0, 1, 0, 1};
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_EQ(recording.records[i].sequence, sequences[i]) << i;
    EXPECT_EQ(recording.records[i].source, sources[i]) << i;
  }
  EXPECT_EQ(recording.sources[0].backward, 1U);
  EXPECT_EQ(testing::all_remarks(recording),
            "a.log: can0: stamp earlier than the one before in the file; sorted by stamp\n"
            "a.log: can1: stamp earlier than the one before in the file; sorted by stamp\n");
}

TEST(RecordingBuilder, RefusesImpossibleStampsWithTheirPlace) {
  RecordingBuilder builder{"a.log"};
  const auto can0 = builder.add_source("can0", SourceKind::kCan, "can");
  EXPECT_FALSE(builder.add(can0, UtcTime{-1}, can::Frame{}, 10));
  EXPECT_FALSE(builder.add(can0, UtcTime{kLatestStamp.ns + 1}, can::Frame{}, 20));
  EXPECT_TRUE(builder.add(can0, kLatestStamp, can::Frame{}, 30));
  const Recording recording = std::move(builder).finish();
  EXPECT_EQ(recording.records.size(), 1U);
  EXPECT_EQ(recording.counters.refused, 2U);
  ASSERT_EQ(recording.remarks.size(), 1U);
  EXPECT_EQ(recording.remarks[0].place, "a.log: byte 10");
  EXPECT_EQ(recording.remarks[0].times, 2U);
}

TEST(RecordingBuilder, GivesTheFirstBytesOfASource) {
  RecordingBuilder builder{"a"};
  const auto one = builder.add_source("one", SourceKind::kReceiver, "");
  const auto two = builder.add_source("two", SourceKind::kOther, "");
  for (const char* text : {"ab", "cd", "ef"}) {
    EXPECT_TRUE(builder.add(one, UtcTime{1}, builder.pool().copy(as_bytes(text)), 0));
    EXPECT_TRUE(builder.add(two, UtcTime{1}, builder.pool().copy(as_bytes("x")), 0));
  }
  EXPECT_EQ(builder.first_bytes(one, 3), "abcd");
  EXPECT_EQ(builder.first_bytes(two, 9), "xxx");
}

}  // namespace
}  // namespace pitwall::traffic
