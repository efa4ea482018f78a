// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/recordings/merge.hpp"

#include <gtest/gtest.h>

#include <set>

#include "hil/replay/recordings/recording_builder.hpp"
#include "tests/hil/replay/recordings/recording_samples.hpp"

namespace pitwall::traffic {
namespace {

// Two sources with many equal stamps; the bytes of each record name it.
Recording some_recording(std::uint32_t seed, const std::string& name) {
  RecordingBuilder builder{name};
  const auto can = builder.add_source("can0", SourceKind::kCan, "can");
  const auto imu = builder.add_source("/imu", SourceKind::kRos, "sensor_msgs/msg/Imu");
  testing::Dice dice{seed};
  for (std::uint32_t i = 0; i < 200; ++i) {
    const UtcTime at{1'000'000'000 + static_cast<std::int64_t>(dice.below(40)) * 1'000};
    if (dice.below(2) == 0) {
      EXPECT_TRUE(builder.add(can, at, testing::some_frame(i), i));
    } else {
      const std::string text = name + " " + std::to_string(i);
      EXPECT_TRUE(builder.add(imu, at, builder.pool().copy(as_bytes(text)), i));
    }
  }
  return std::move(builder).finish();
}

std::vector<std::string> lines_of(const Recording& recording) {
  std::vector<std::string> lines;
  for (const Record& record : recording.records)
    lines.push_back(std::to_string(record.source) + " " + std::to_string(record.sequence) + " " +
                    testing::line_of(recording, record));
  return lines;
}

std::vector<MergeInput> two(const std::string& label_1, const std::string& label_2) {
  std::vector<MergeInput> inputs;
  inputs.push_back({some_recording(1, "a"), label_1, {}});
  inputs.push_back({some_recording(2, "b"), label_2, {}});
  return inputs;
}

TEST(Merge, NoRecordIsLostAndTheOrderIsTotal) {
  const Result<Recording, Problem> merged = merge(two("car7", "car9"));
  ASSERT_TRUE(merged);
  testing::expect_sound(*merged);
  EXPECT_EQ(merged->records.size(), 400U);
  ASSERT_EQ(merged->sources.size(), 4U);
  EXPECT_EQ(merged->sources[0].name, "car7:can0");
  EXPECT_EQ(merged->sources[3].name, "car9:/imu");
  for (std::size_t i = 1; i < merged->records.size(); ++i)
    EXPECT_TRUE(precedes(merged->records[i - 1], merged->records[i])) << i;
}

TEST(Merge, OfEqualStampsTheEarlierInputComesFirst) {
  const auto merged = merge(two("car7", "car9"));
  std::size_t equal = 0;
  for (std::size_t i = 1; i < merged->records.size(); ++i) {
    const Record &before = merged->records[i - 1], &record = merged->records[i];
    if (before.at != record.at) continue;
    ++equal;
    EXPECT_LE(before.source / 2, record.source / 2) << i;
  }
  EXPECT_GT(equal, 100U);
}

TEST(Merge, TheSameInputsGiveTheSameOutput) {
  EXPECT_EQ(lines_of(*merge(two("a", "b"))), lines_of(*merge(two("a", "b"))));
}

TEST(Merge, RecordsOfOneInputKeepTheirOrder) {
  const Recording alone = some_recording(2, "b");
  const auto merged = merge(two("a", "b"));
  std::vector<std::string> of_b;
  for (const Record& record : merged->records)
    if (record.source >= 2)
      of_b.push_back(testing::line_of(*merged, record).substr(std::string{"b:"}.size()));
  std::vector<std::string> expected;
  for (const Record& record : alone.records) expected.push_back(testing::line_of(alone, record));
  EXPECT_EQ(of_b, expected);
}

TEST(Merge, InStepsIsTheSameAsAtOnce) {
  const auto three = [](const std::string& label) {
    std::vector<MergeInput> inputs = two(label + "1", label + "2");
    inputs.push_back({some_recording(3, "c"), label + "3", {}});
    return inputs;
  };
  std::vector<MergeInput> inputs = three("x");
  std::vector<MergeInput> first;
  first.push_back(std::move(inputs[0]));
  first.push_back(std::move(inputs[1]));
  std::vector<MergeInput> second;
  second.push_back({*merge(std::move(first)), "", {}});
  second.push_back(std::move(inputs[2]));
  EXPECT_EQ(lines_of(*merge(std::move(second))), lines_of(*merge(three("x"))));
}

TEST(Merge, OfOneRecordingIsTheRecording) {
  const Recording alone = some_recording(5, "a");
  std::vector<MergeInput> inputs;
  inputs.push_back({some_recording(5, "a"), "", {}});
  const auto merged = merge(std::move(inputs));
  EXPECT_EQ(lines_of(*merged), lines_of(alone));
  EXPECT_EQ(merged->sources, alone.sources);
  EXPECT_EQ(merged->remarks, alone.remarks);
  EXPECT_EQ(merged->counters, alone.counters);
}

TEST(Merge, SegmentsWithTheSameSourcesBecomeOne) {
  const auto merged = merge(two("", ""));
  testing::expect_sound(*merged);
  ASSERT_EQ(merged->sources.size(), 2U);
  EXPECT_EQ(merged->sources[0].records + merged->sources[1].records, 400U);
  std::set<std::pair<std::uint32_t, std::uint64_t>> numbers;
  for (const Record& record : merged->records) numbers.emplace(record.source, record.sequence);
  EXPECT_EQ(numbers.size(), 400U) << "each sequence once";
}

TEST(Merge, AnOffsetMovesEveryStampOfItsInput) {
  std::vector<MergeInput> inputs = two("a", "b");
  inputs[1].offset = seconds(-1);
  const auto merged = merge(std::move(inputs));
  testing::expect_sound(*merged);
  EXPECT_LT(merged->sources[2].last, merged->sources[0].first);
  EXPECT_EQ(merged->first(), UtcTime{});
}

TEST(Merge, RefusesAnOffsetBeyondALifetime) {
  for (const Duration offset :
       {kLongestOffset + nanoseconds(1), -kLongestOffset - nanoseconds(1)}) {
    std::vector<MergeInput> inputs = two("car7", "b");
    inputs[0].offset = offset;
    const auto merged = merge(std::move(inputs));
    ASSERT_FALSE(merged);
    EXPECT_EQ(to_string(merged.error()),
              "car7: error: offset out of range: at most 63 years either way");
  }
  std::vector<MergeInput> inputs = two("car7", "b");
  inputs[0].offset = kLongestOffset;
  EXPECT_TRUE(merge(std::move(inputs)));
}

TEST(Merge, OfNothingIsNothing) {
  const auto merged = merge({});
  ASSERT_TRUE(merged);
  EXPECT_TRUE(merged->records.empty() && merged->sources.empty());
}

}  // namespace
}  // namespace pitwall::traffic
