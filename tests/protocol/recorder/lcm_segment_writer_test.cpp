// SPDX-License-Identifier: Apache-2.0
#include "protocol/recorder/lcm_segment_writer.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <string>

#include "protocol/recorder/can_record.hpp"
#include "protocol/recorder/raw_record.hpp"
#include "protocol/recorder/segment_chain.hpp"
#include "protocol/recording/mcap_reader.hpp"
#include "protocol/telemetry/export/lcm_schema.hpp"
#include "tests/protocol/recorder/memory_disk.hpp"
#include "tests/protocol/recorder/recorded_time.hpp"

namespace pitwall::recorder {
namespace {

using telemetry::Group;

std::uint64_t number_at(std::span<const std::uint8_t> data, std::size_t place) {
  std::uint64_t value = 0;
  for (const std::uint8_t byte : data.subspan(place * 8, 8)) value = value << 8U | byte;
  return value;
}

struct TwinSource {
  MemoryDisk disk, lcm_disk;
  SegmentChain chain{disk, {.clock = kClock}, &lcm_disk};
  Instant now = kStart;
  telemetry::Values values;
  std::uint64_t given = 0;

  void give(std::uint16_t channel, std::span<const std::uint8_t> data) {
    chain.take(
        {.channel = channel, .logged = now, .published = now - milliseconds(30), .data = data},
        now);
    ++given;
  }
  void run(Duration length) {
    for (const Instant end = now + length; now < end; now += kTick) {
      values[telemetry::fields_of(Group::kEgo).first] = static_cast<double>(given);
      give(channel_of(Group::kEgo), encode(Group::kEgo, values).span());
      chain.turn(now);
    }
  }
};

std::uint64_t events_of(const MemoryDisk& disk) {
  std::uint64_t events = 0;
  for (const auto& [name, bytes] : disk.files) {
    recording::LcmLogReader reader{bytes};
    while (reader.next()) ++events;
    EXPECT_EQ(reader.bytes_skipped(), 0U) << name;
  }
  return events;
}

TEST(LcmSegmentWriter, EverySegmentHasItsLogUnderTheSameNameWithTheSameRecords) {
  TwinSource source;
  source.run(seconds(130));
  source.chain.close();
  ASSERT_EQ(source.disk.files.size(), 3U);
  ASSERT_EQ(source.lcm_disk.files.size(), 3U);
  for (auto segment = source.disk.files.begin(), log = source.lcm_disk.files.begin();
       log != source.lcm_disk.files.end(); ++segment, ++log) {
    EXPECT_EQ(log->first, segment->first.substr(0, segment->first.size() - 5) + ".lcm");
    recording::McapReader messages{segment->second};
    recording::LcmLogReader events{log->second};
    while (const auto message = messages.next()) {
      if (message->channel == kSnapshotChannel) continue;
      const auto event = events.next();
      ASSERT_TRUE(event);
      EXPECT_EQ(event->at.ns, static_cast<std::int64_t>(message->logged_ns));
      EXPECT_EQ(event->channel, messages.channels().at(message->channel).topic);
    }
    EXPECT_FALSE(events.next());
  }
  EXPECT_EQ(source.chain.figures().lcm.events, source.given);
  EXPECT_EQ(source.chain.figures().lcm.lost, 0U);
}

TEST(LcmSegmentWriter, AGroupIsItsFingerprintItsSampleTimeAndItsFields) {
  TwinSource source;
  source.run(kTick);
  source.chain.close();
  recording::LcmLogReader reader{source.lcm_disk.files.begin()->second};
  const auto event = reader.next();
  ASSERT_TRUE(event);
  const auto [first, count] = telemetry::fields_of(Group::kEgo);
  ASSERT_EQ(event->data.size(), (2 + count) * sizeof(double));
  EXPECT_EQ(number_at(event->data, 0),
            telemetry::lcm_fingerprint(telemetry::lcm_type(Group::kEgo)));
  EXPECT_EQ(number_at(event->data, 1), (1'700'000'100'000ULL - 30) * 1'000);
  EXPECT_EQ(std::bit_cast<double>(number_at(event->data, 2)), 0.0);
  for (std::size_t i = 1; i < count; ++i) {
    EXPECT_TRUE(std::isnan(std::bit_cast<double>(number_at(event->data, 2 + i)))) << i;
  }
}

TEST(LcmSegmentWriter, TextsDatagramsAndFramesHaveTheirLength) {
  TwinSource source;
  const std::vector<std::uint8_t> text{'{', '}'};
  source.give(channel_of(Topic::kMark), text);
  DatagramBytes air{};
  source.give(kDownChannel, encode(RadioDatagram{.path = 1, .bytes = text}, air));
  source.give(kReceiverChannel, text);
  CanBytes bytes{};
  source.give(kCanInChannel, encode(can::Frame{.id = 5, .length = 3}, bytes));
  source.chain.close();
  recording::LcmLogReader reader{source.lcm_disk.files.begin()->second};
  constexpr std::size_t kHead = 16;
  const auto mark = reader.next();
  EXPECT_EQ(mark->channel, "/base/mark");
  EXPECT_EQ(mark->data.size(), kHead + 4 + 2 + 1);
  EXPECT_EQ(mark->data.back(), 0);
  EXPECT_EQ(reader.next()->data.size(), kHead + 2 + 4 + 4 + 4 + 2);
  EXPECT_EQ(reader.next()->data.size(), kHead + 4 + 2);
  const auto frame = reader.next();
  EXPECT_EQ(frame->channel, "/can/in");
  EXPECT_EQ(frame->data.size(), kHead + 4 + 3 + 4 + 3);
}

TEST(LcmSegmentWriter, WhereItsDiskIsFullTheSegmentGoesOnAndTheNextOneHasALogAgain) {
  TwinSource source;
  source.run(seconds(10));
  source.lcm_disk.capacity = source.lcm_disk.used() + 5'000;
  source.run(seconds(30));
  const ChainFigures full = source.chain.figures();
  EXPECT_EQ(full.lost + full.interruptions, 0U);
  EXPECT_GT(full.lcm.lost, 100U);
  source.lcm_disk.capacity = std::uint64_t{1} << 30U;
  source.run(seconds(40));
  source.chain.close();
  EXPECT_EQ(source.lcm_disk.files.size(), 2U);
  const LcmFigures figures = source.chain.figures().lcm;
  EXPECT_EQ(events_of(source.lcm_disk), figures.events);
  EXPECT_EQ(figures.events + figures.lost, source.given);
}

TEST(LcmSegmentWriter, ASegmentThatIsGivenUpTakesItsLogWithIt) {
  TwinSource source;
  source.disk.capacity = 1'000;
  source.run(seconds(2));
  EXPECT_TRUE(source.disk.files.empty());
  EXPECT_TRUE(source.lcm_disk.files.empty());
}

}  // namespace
}  // namespace pitwall::recorder
