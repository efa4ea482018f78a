// SPDX-License-Identifier: Apache-2.0
#include "protocol/recording/lcm_log.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

#include "tests/protocol/recording/mcap_samples.hpp"

namespace pitwall::recording {
namespace {

constexpr std::int64_t kEvents = 40;

std::string channel_of(std::int64_t i) { return i % 3 == 0 ? "EGO" : "TYRES_" + std::to_string(i); }
// Holds the sync word itself now and then.
std::vector<std::uint8_t> data_of(std::int64_t i) {
  std::vector<std::uint8_t> data(static_cast<std::size_t>(i % 7), static_cast<std::uint8_t>(i));
  if (i % 5 == 0) data.insert(data.end(), {0xED, 0xA1, 0xDA, 0x01, 0, 0, 0, 0});
  return data;
}
UtcTime at_of(std::int64_t i) { return {1'700'000'000'000'000'000 + i * 1'000}; }

std::vector<std::uint8_t> logged() {
  testing::MemoryFile file;
  LcmLogWriter writer{file.sink()};
  for (std::int64_t i = 0; i < kEvents; ++i) {
    EXPECT_TRUE(writer.write(at_of(i), channel_of(i), data_of(i)));
  }
  EXPECT_EQ(writer.counters().bytes, file.bytes.size());
  return file.bytes;
}

std::int64_t check_in_order(LcmLogReader& reader) {
  std::int64_t i = 0;
  for (; const auto event = reader.next(); ++i) {
    EXPECT_EQ(event->number, i);
    EXPECT_EQ(event->at, at_of(i));
    EXPECT_EQ(event->channel, channel_of(i));
    EXPECT_TRUE(std::ranges::equal(event->data, data_of(i)));
  }
  return i;
}

TEST(LcmLog, TheBytesOfAnEvent) {
  testing::MemoryFile file;
  LcmLogWriter writer{file.sink()};
  const std::array<std::uint8_t, 2> data{7, 8};
  ASSERT_TRUE(writer.write(UtcTime{0x0102'0304'0506 * 1'000 + 999}, "AB", data));
  const std::vector<std::uint8_t> expected{0xED, 0xA1, 0xDA, 0x01, 0, 0, 0,   0,   0, 0, 0,
                                           0,    0,    0,    1,    2, 3, 4,   5,   6, 0, 0,
                                           0,    2,    0,    0,    0, 2, 'A', 'B', 7, 8};
  EXPECT_EQ(file.bytes, expected);
}

TEST(LcmLog, ReadsWhatWasWritten) {
  const auto file = logged();
  LcmLogReader reader{file};
  EXPECT_EQ(check_in_order(reader), kEvents);
  EXPECT_EQ(reader.events(), static_cast<std::uint64_t>(kEvents));
  EXPECT_EQ(reader.bytes_skipped(), 0U);
}

TEST(LcmLog, CutAnywhereGivesTheWholeEventsInFrontOfTheCut) {
  const auto file = logged();
  std::int64_t before = 0;
  for (std::size_t length = 0; length <= file.size(); ++length) {
    LcmLogReader reader{std::span{file}.first(length)};
    const std::int64_t count = check_in_order(reader);
    EXPECT_TRUE(count == before || count == before + 1) << length;
    before = count;
  }
  EXPECT_EQ(before, kEvents);
}

TEST(LcmLog, BehindDamageItGoesOn) {
  const auto whole = logged();
  for (std::size_t at = 0; at < whole.size(); ++at) {
    auto file = whole;
    file[at] ^= 0x80U;
    LcmLogReader reader{file};
    std::int64_t events = 0;
    while (reader.next()) ++events;
    EXPECT_GE(events, kEvents - 2) << at;
    EXPECT_LE(events, kEvents + 1) << at;
  }
}

TEST(LcmLog, ThePlayerOfLcmPlaysIt) {
  ASSERT_EQ(std::system("command -v lcm-logplayer >/dev/null"), 0)
      << "lcm-logplayer is not installed (./pitwall setup)";
  const auto file = logged();
  const std::string in = ::testing::TempDir() + "pitwall_in.lcm";
  const std::string out = ::testing::TempDir() + "pitwall_out.lcm";
  std::ofstream{in, std::ios::binary}.write(reinterpret_cast<const char*>(file.data()),
                                            static_cast<std::streamsize>(file.size()));
  // It publishes into a file of its own making instead of to a network.
  const std::string url = "--lcm-url='file://" + out + "?mode=w'";
  ASSERT_EQ(std::system(("lcm-logplayer " + url + " -s 100 " + in + " >/dev/null").c_str()), 0);
  std::ifstream stream{out, std::ios::binary};
  const std::vector<char> raw{std::istreambuf_iterator<char>{stream}, {}};
  const std::vector<std::uint8_t> played(raw.begin(), raw.end());
  LcmLogReader reader{played};
  std::int64_t i = 0;
  for (; const auto event = reader.next(); ++i) {
    EXPECT_EQ(event->channel, channel_of(i));
    EXPECT_TRUE(std::ranges::equal(event->data, data_of(i)));
  }
  EXPECT_EQ(i, kEvents);
}

TEST(LcmLog, EveryRefusalIsCountedByItsReason) {
  bool broken = false;
  LcmLogWriter writer{[&](std::span<const std::uint8_t>) { return !broken; }};
  const std::array<std::uint8_t, 1> data{1};
  EXPECT_FALSE(writer.write(at_of(0), "", data));
  EXPECT_FALSE(writer.write(at_of(0), std::string(kLcmChannelMax + 1, 'x'), data));
  EXPECT_FALSE(writer.write(UtcTime{-1}, "A", data));
  EXPECT_TRUE(writer.write(at_of(0), std::string(kLcmChannelMax, 'x'), data));
  broken = true;
  EXPECT_FALSE(writer.write(at_of(0), "A", data));
  broken = false;
  EXPECT_FALSE(writer.write(at_of(0), "A", data));  // the file has a gap
  const LcmLogWriter::Counters& counters = writer.counters();
  EXPECT_EQ(counters.refused_channel, 2U);
  EXPECT_EQ(counters.refused_time, 1U);
  EXPECT_EQ(counters.refused_sink, 2U);
  EXPECT_EQ(counters.events, 1U);
}

}  // namespace
}  // namespace pitwall::recording
