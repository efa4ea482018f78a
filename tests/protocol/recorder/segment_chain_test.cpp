// SPDX-License-Identifier: Apache-2.0
#include "protocol/recorder/segment_chain.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "protocol/recording/mcap_reader.hpp"
#include "tests/protocol/recorder/memory_disk.hpp"
#include "tests/protocol/recorder/recorded_time.hpp"

namespace pitwall::recorder {
namespace {

struct ChainSource {
  MemoryDisk disk;
  ChainParams params{.run = {{"mode", "HIL"}}, .clock = kClock};
  SegmentChain chain;
  Instant now = kStart;
  telemetry::Values values;
  std::uint64_t given = 0;

  ChainSource() : chain(disk, params) {}

  void run(Duration length) {
    for (const Instant end = now + length; now < end; now += kTick) {
      values[telemetry::fields_of(telemetry::Group::kEgo).first] = static_cast<double>(given++);
      const GroupBytes bytes = encode(telemetry::Group::kEgo, values);
      chain.take({.channel = channel_of(telemetry::Group::kEgo),
                  .logged = now,
                  .published = now - milliseconds(30),
                  .data = bytes.span()},
                 now);
      chain.turn(now);
    }
  }
};

struct Seen {
  std::uint64_t samples = 0, snapshots = 0;
  std::vector<std::int64_t> logged;  // of samples
  recording::McapEnd end{};
};

Seen look(std::span<const std::uint8_t> file, Seen seen = {}) {
  recording::McapReader reader{file};
  while (const auto m = reader.next()) {
    if (m->channel == kSnapshotChannel) ++seen.snapshots;
    if (m->channel != channel_of(telemetry::Group::kEgo)) continue;
    ++seen.samples;
    seen.logged.push_back(static_cast<std::int64_t>(m->logged_ns) - seconds(1'700'000'000).ns);
  }
  seen.end = reader.end();
  return seen;
}

TEST(SegmentChain, SegmentsOfAMinuteHoldEveryRecordOnceAndBeginWithAPicture) {
  ChainSource source;
  source.run(seconds(150));
  source.chain.close();
  ASSERT_EQ(source.disk.files.size(), 3U);
  Seen all;
  for (const auto& [name, bytes] : source.disk.files) {
    all = look(bytes, all);
    EXPECT_EQ(all.end, recording::McapEnd::kComplete) << name;
    recording::McapReader reader{bytes};
    const auto first = reader.next();
    EXPECT_EQ(first->channel, kSnapshotChannel);
    EXPECT_TRUE(clock_of(reader.run()));
    EXPECT_EQ(reader.run().front(), (std::pair<std::string, std::string>{"mode", "HIL"}));
  }
  EXPECT_EQ(all.samples, source.given);
  EXPECT_EQ(all.snapshots, 15U);
  EXPECT_TRUE(std::ranges::is_sorted(all.logged));
  const ChainFigures& figures = source.chain.figures();
  EXPECT_EQ(figures.segments, 3U);
  EXPECT_EQ(figures.lost + figures.refused + figures.interruptions, 0U);
  EXPECT_EQ(figures.records, source.given + 15);
}

TEST(SegmentChain, NamesTellTheTimeAndSortInIt) {
  ChainSource source;
  source.run(seconds(70));
  std::vector<std::string> names;
  for (const auto& [name, bytes] : source.disk.files) names.push_back(name);
  EXPECT_EQ(names, (std::vector<std::string>{"pitwall_20231114T221500.000Z_00000.mcap",
                                             "pitwall_20231114T221600.000Z_00001.mcap"}));
}

TEST(SegmentChain, AtAnyMomentLessThanASecondIsNotOnTheDisk) {
  ChainSource source;
  for (int i = 0; i < 200; ++i) {
    source.run(milliseconds(60));
    const Seen seen = look(source.disk.files.begin()->second);
    const std::int64_t newest = seen.logged.empty() ? kStart.ns : seen.logged.back();
    EXPECT_LE((source.now - Instant{newest}).ns, seconds(1).ns);
  }
}

TEST(SegmentChain, AFullDiskStopsNothingAndTheRecordingGoesOnWhenThereIsRoom) {
  ChainSource source;
  source.run(seconds(5));
  source.disk.capacity = source.disk.used() + 10'000;
  source.run(seconds(30));
  EXPECT_FALSE(source.chain.figures().recording);
  EXPECT_EQ(source.chain.figures().interruptions, 1U);
  EXPECT_NE(source.chain.figures().problem.find("full"), std::string::npos);
  EXPECT_GT(source.chain.figures().lost, 1'000U);
  ASSERT_EQ(source.disk.files.size(), 1U);  // no row of empty files
  source.disk.capacity = std::uint64_t{1} << 30U;
  source.run(seconds(5));
  EXPECT_TRUE(source.chain.figures().recording);
  source.chain.close();
  ASSERT_EQ(source.disk.files.size(), 2U);
  Seen all;
  for (const auto& [name, bytes] : source.disk.files) all = look(bytes, all);
  EXPECT_EQ(all.end, recording::McapEnd::kComplete);
  EXPECT_EQ(all.samples + source.chain.figures().lost, source.given + 0U);
}

TEST(SegmentChain, AfterAGapThePictureStillHoldsWhatWasKnown) {
  ChainSource source;
  source.disk.capacity = 1'000;  // full from the start
  source.run(seconds(3));
  EXPECT_TRUE(source.disk.files.empty());
  source.disk.capacity = std::uint64_t{1} << 30U;
  source.run(seconds(2));
  source.chain.close();
  recording::McapReader reader{source.disk.files.begin()->second};
  const auto first = reader.next();
  ASSERT_EQ(first->channel, kSnapshotChannel);
  Known known;
  const auto fields = ChannelFields::of(reader.channels().at(kSnapshotChannel));
  ASSERT_TRUE(fields->decode(first->data, known));
  EXPECT_GT(known.value[telemetry::fields_of(telemetry::Group::kEgo).first], 100.0);
}

}  // namespace
}  // namespace pitwall::recorder
