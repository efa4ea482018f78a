// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/replay/sensor_traffic.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "hil/replay/recordings/recording_reader.hpp"
#include "protocol/gnss/novatel_stream.hpp"
#include "tests/benchmarks/replay/sample_log.hpp"

namespace pitwall::benchmarks {
namespace {

constexpr UtcTime kBegin{kNanosecondsPerSecond * 1'700'000'000};

TEST(SensorTraffic, IsTheSameEveryTimeAndInTheOrderOfItsStamps) {
  const auto traffic = sensor_traffic(kBegin, seconds(2));
  EXPECT_EQ(traffic, sensor_traffic(kBegin, seconds(2)));
  EXPECT_TRUE(std::ranges::is_sorted(traffic, {}, &SensorDatagram::at));
  EXPECT_GT(traffic.front().at, kBegin);
  EXPECT_LT(traffic.back().at, (UtcTime{kBegin.ns + seconds(2).ns}));
}

TEST(SensorTraffic, IsWhatTwoReceiversSay) {
  for (std::size_t receiver = 0; receiver < kReceivers; ++receiver) {
    std::map<std::uint16_t, int> messages;
    gnss::NovatelStream stream;
    for (const SensorDatagram& datagram : sensor_traffic(kBegin, seconds(4)))
      if (datagram.receiver == receiver)
        stream.feed(datagram.bytes,
                    [&](const gnss::NovatelFrame& frame) { ++messages[frame.header.id]; });
    EXPECT_EQ(stream.counters().garbage_bytes, 0U);
    ASSERT_EQ(messages.size(), 3U);
    EXPECT_NEAR(messages[gnss::BestPos::kId], 4 * 20, 1);
    EXPECT_NEAR(messages[gnss::BestVel::kId], 4 * 20, 1);
    EXPECT_NEAR(messages[gnss::RawImuSx::kId], 4 * 125, 1);
  }
}

TEST(SensorTraffic, ARecordingGivesLogAndDatagramsBack) {
  const replay::CanLog log = replay::sample_log(seconds(1));
  const auto traffic = sensor_traffic(log.frames.front().at, seconds(1));
  auto bytes = to_recording(log, traffic);
  ASSERT_TRUE(bytes) << to_string(bytes.error());
  const auto recording = traffic::read_recording(*std::move(bytes), "f");
  ASSERT_TRUE(recording) << to_string(recording.error());
  std::size_t frame = 0;
  std::vector<SensorDatagram> datagrams;
  for (const traffic::Record& record : recording->records) {
    const std::string& source = recording->sources[record.source].name;
    if (const can::Frame* read = record.frame()) {
      EXPECT_EQ(source, "/can/in");
      ASSERT_LT(frame, log.frames.size());
      EXPECT_EQ(*read, log.frames[frame].frame);
      EXPECT_EQ(record.at, log.frames[frame++].at);
    } else {
      const auto of = record.bytes();
      datagrams.push_back(
          {record.at, source == "/gnss/1" ? 1U : 0U, std::vector(of.begin(), of.end())});
    }
  }
  EXPECT_EQ(frame, log.frames.size());
  EXPECT_EQ(datagrams, traffic);
}

TEST(SensorTraffic, AFrameWhoseStampGoesBackIsDueWithTheOneBefore) {
  replay::CanLog log = replay::sample_log(milliseconds(100));
  const can::Frame second = log.frames[1].frame;
  log.frames[1].at.ns -= kNanosecondsPerSecond;
  auto bytes = to_recording(log, {});
  ASSERT_TRUE(bytes);
  const auto recording = traffic::read_recording(*std::move(bytes), "f");
  ASSERT_TRUE(recording);
  ASSERT_NE(recording->records[1].frame(), nullptr);
  EXPECT_EQ(*recording->records[1].frame(), second);
  EXPECT_EQ(recording->records[1].at, log.frames[0].at);
}

TEST(SensorTraffic, WhatAFileDoesNotTakeIsTold) {
  const std::vector<SensorDatagram> before_time{{{-5}, 0, {1, 2, 3}}};
  const auto bytes = to_recording({}, before_time);
  ASSERT_FALSE(bytes);
  EXPECT_NE(to_string(bytes.error()).find("1 records"), std::string::npos);
}

}  // namespace
}  // namespace pitwall::benchmarks
