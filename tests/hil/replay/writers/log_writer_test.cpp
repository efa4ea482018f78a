// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/writers/log_writer.hpp"

#include <gtest/gtest.h>

#include "hil/replay/formats/log_reader.hpp"
#include "tests/hil/replay/formats/made_log.hpp"

namespace pitwall::replay {
namespace {

CanLog read_again(const CanLog& log, const std::string& name) {
  const auto written = write_can_log(log, name);
  EXPECT_TRUE(written) << name;
  if (!written) return {};
  auto read = read_can_log(written->bytes, name);
  EXPECT_TRUE(read) << (read ? "" : to_string(read.error()));
  return read ? *std::move(read) : CanLog{};
}

TEST(LogWriter, OneCaptureInEveryFormatGivesTheSameFrames) {
  for (const std::int64_t step_ns : {1'000, 1}) {
    const CanLog log = make_log({.frames = 600, .step_ns = step_ns});
    for (const std::string name :
         {"a.log", "a.asc", "a.blf", "a.trc", "a.pcapng", "a.log.gz", "a.trc.gz"}) {
      const CanLog read = read_again(log, name);
      EXPECT_EQ(read.channels, log.channels) << name;
      EXPECT_EQ(read.frames, log.frames) << name;
      const bool has_comments = name.starts_with("a.trc");
      EXPECT_EQ(read.counters, (LogCounters{.other_records = name == "a.asc" ? 1U : 0U,
                                            .comments = has_comments ? 12U : 0U}))
          << name;
      EXPECT_TRUE(read.remarks.empty()) << name;
    }
  }
}

TEST(LogWriter, PcapKeepsAllButDirectionsAndChannels) {
  for (const std::int64_t step_ns : {1'000, 1}) {
    CanLog log = make_log({.frames = 600, .channels = 1, .step_ns = step_ns});
    const CanLog read = read_again(log, "a.pcap");
    for (LoggedFrame& logged : log.frames) logged.direction = LoggedDirection::kUnknown;
    EXPECT_EQ(read.frames, log.frames);
    EXPECT_EQ(read.channels, log.channels);
  }
}

TEST(LogWriter, WhatAFormatCannotKeepIsTold) {
  CanLog log = make_log({.frames = 10, .channels = 2});
  log.channels = {"vcan7", "can0"};
  log.counters.error_frames = 3;
  log.frames[0].direction = LoggedDirection::kUnknown;
  const auto reported = [&](const std::string& name) {
    std::string out;
    const auto written = write_can_log(log, name);
    for (const std::string& loss : written->losses) out += loss + "\n";
    return out;
  };
  EXPECT_EQ(reported("a.log"), "3 error frames are not written\n");
  EXPECT_EQ(reported("a.pcapng"), "3 error frames are not written\n");
  for (const std::string name : {"a.asc", "a.blf", "a.trc", "a.trc.gz"})
    EXPECT_EQ(reported(name),
              "3 error frames are not written\nthe name vcan7 becomes channel 2\n"
              "1 frames of unknown direction become received ones\n");
  EXPECT_EQ(reported("a.pcap"),
            "3 error frames are not written\nthe 2 channels and their names become one\n"
            "9 directions are not written\n");
}

TEST(LogWriter, ChannelsKeepTheirNumbersAndOthersGetWhatIsLeft) {
  CanLog log;
  log.channels = {"b", "can0", "can2", "a"};
  EXPECT_EQ(channel_numbers_of(log), (std::vector<unsigned>{2, 1, 3, 4}));
}

TEST(LogWriter, AnotherSuffixAndAStampBeyondTheFormatAreRefused) {
  CanLog log = make_log({.frames = 3});
  for (const std::string name : {"a.txt", "a.gz", "a.log.gz.gz"})
    EXPECT_FALSE(write_can_log(log, name).has_value()) << name;
  log.frames[1].at.ns = 5'000'000'000 * kNanosecondsPerSecond;
  EXPECT_FALSE(write_can_log(log, "a.pcap").has_value());
  EXPECT_TRUE(write_can_log(log, "a.pcapng").has_value());
}

}  // namespace
}  // namespace pitwall::replay
