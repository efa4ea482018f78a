// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/candump_log.hpp"

#include <gtest/gtest.h>

#include <random>

namespace pitwall::replay {
namespace {

CandumpLog parse(const std::string& text) {
  auto log = parse_candump_log(text, "f.log");
  EXPECT_TRUE(log.has_value()) << (log ? "" : to_string(log.error()));
  return log ? *std::move(log) : CandumpLog{};
}

TEST(CandumpLog, EveryFormOfAFrameIsUnderstood) {
  const auto log = parse(
      "(1398128223.803317) can0 166#D0320009\n"
      "(1398128223.803317123) can1 18DAF110#\n"
      "(1.5) can0 7FF#R\n"
      "(1.5) can0 000#R8 T\n"
      "(1.5) vcan_long.name1 1FFFFFFF#1122334455667788 R\r\n"
      "(1.5)   can0   123##1AABBCC\n"
      "(1.5) can0 123##0\n"
      "(1.5) can0 123#11.22.33\n"
      "(1.5) can0 123#1122334455667788_F\n"
      "(1.5) can0 0000012a#ff");
  ASSERT_EQ(log.frames.size(), 10U);
  EXPECT_EQ(log.channels, (std::vector<std::string>{"can0", "can1", "vcan_long.name1"}));
  const auto& f = log.frames;
  EXPECT_EQ(f[0].at.ns, 1'398'128'223'803'317'000);
  EXPECT_EQ(f[0].frame.id, 0x166U);
  EXPECT_EQ(f[0].frame.length, 4);
  EXPECT_EQ(f[0].frame.data[0], 0xD0);
  EXPECT_EQ(f[1].at.ns, 1'398'128'223'803'317'123);
  EXPECT_TRUE(f[1].frame.extended);
  EXPECT_EQ(f[1].channel, 1);
  EXPECT_TRUE(f[2].frame.remote);
  EXPECT_EQ(f[2].at.ns, 1'500'000'000);
  EXPECT_EQ(f[3].frame.length, 8);
  EXPECT_EQ(f[3].direction, LoggedDirection::kTransmitted);
  EXPECT_EQ(f[4].direction, LoggedDirection::kReceived);
  EXPECT_EQ(f[4].frame.id, 0x1FFFFFFFU);
  EXPECT_TRUE(f[5].frame.fd);
  EXPECT_EQ(f[5].fd_flags, 1);
  EXPECT_EQ(f[5].frame.length, 3);
  EXPECT_EQ(f[6].frame.length, 0);
  EXPECT_EQ(f[7].frame.data[2], 0x33);
  EXPECT_EQ(f[8].frame.length, 8);
  EXPECT_TRUE(f[9].frame.extended);  // eight digits, though the number is small
}

TEST(CandumpLog, WhatIsNoFrameIsSkippedAndCounted) {
  const auto log = parse(
      "\n(1.000000) can0 001#\n  \n"
      "DROPCOUNT: dropped 12 CAN frames on 'can0' socket (total drops 12)\n"
      "DROPCOUNT: dropped 1 CAN frame on 'can0' socket (total drops 13)\n"
      "(1.000001) can0 20000004#000C000000000000\n"
      "(1.000002) can0 002#\n");
  EXPECT_EQ(log.frames.size(), 2U);
  EXPECT_EQ(log.counters.blank_lines, 2U);
  EXPECT_EQ(log.counters.drop_lines, 2U);
  EXPECT_EQ(log.counters.recorder_drops, 13U);
  EXPECT_EQ(log.counters.error_frames, 1U);
}

TEST(CandumpLog, TheOrderOfTheFileIsKeptWhateverTheStampsSay) {
  const auto log = parse(
      "(2.0) can0 001#\n(2.0) can0 002#\n(1.0) can0 003#\n(1.0) can0 004#\n(3.0) can0 005#\n");
  ASSERT_EQ(log.frames.size(), 5U);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(log.frames[i].frame.id, i + 1);
  EXPECT_EQ(log.counters.backward_stamps, 1U);
}

TEST(CandumpLog, AProblemNamesFileLineAndColumn) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"x", "1:1"},
      {"(1.0) can0 001#\n1.0) can0 001#\n", "2:1"},
      {std::string("(1.0) can0 001#\0", 16) + "\n", "1:16"},
      {std::string("(1.0) can0 001#11\n(1.0) ca\0n0 001#1\n", 37), "2:18"},
      {"(1.0) can0 001#11\r\n(1.0) can0 001#1\r\n", "2:17"},
      {"(1.0) can0 " + std::string(100'000, '1') + "\n", "1:20"},
      {std::string(100'000, ' ') + "x\n", "1:1"},
      {"(a.0) can0 001#", "1:2"},
      {"(1) can0 001#", "1:3"},
      {"(1.) can0 001#", "1:4"},
      {"(1.0000000001) can0 001#", "1:13"},
      {"(1234567890 1.0) can0 001#", "1:12"},
      {"(9000000001.0) can0 001#", "1:12"},
      {"(1.0 can0 001#", "1:5"},
      {"(1.0) ", "1:7"},
      {"(1.0) an_interface_name_too_long 001#", "1:7"},
      {"(1.0) can0 12#", "1:14"},
      {"(1.0) can0 1234#", "1:16"},
      {"(1.0) can0 800#", "1:12"},
      {"(1.0) can0 123", "1:15"},
      {"(1.0) can0 123#1", "1:17"},
      {"(1.0) can0 123#112233445566778899", "1:32"},
      {"(1.0) can0 123#R9", "1:17"},
      {"(1.0) can0 123#11 X", "1:19"},
      {"(1.0) can0 123#11Z", "1:18"},
      {"(1.0) can0 123##", "1:17"},
      {"(1.0) can0 123##0112233445566778899", "1:36"},
      {"(1.0) can0 123#11_9", "1:19"},
  };
  for (const auto& [text, place] : cases) {
    const auto log = parse_candump_log(text, "f.log");
    ASSERT_FALSE(log.has_value()) << text;
    EXPECT_EQ(log.error().place, "f.log:" + place) << text << ": " << log.error().what;
    EXPECT_FALSE(log.error().what.empty());
  }
}

TEST(CandumpLog, MoreInterfacesThanAllowedIsAProblem) {
  std::string text;
  for (std::size_t i = 0; i <= kMaxChannels; ++i) text += "(1.0) c" + std::to_string(i) + " 001#\n";
  EXPECT_FALSE(parse_candump_log(text, "f").has_value());
}

TEST(CandumpLog, ALastLineThatIsCutOffCostsOnlyItself) {
  const std::string whole = "(1.000000) can0 001#11\n(1.000001) can0 002##1AABBCC T";
  for (std::size_t length = whole.find('\n') + 1; length <= whole.size(); ++length) {
    const auto log = parse_candump_log(whole.substr(0, length), "f.log");
    ASSERT_TRUE(log.has_value()) << length;
    ASSERT_EQ(log->frames[0].frame.id, 1U);
    const bool is_last_there = log->frames.size() == 2;
    const bool is_empty = length == whole.find('\n') + 1;
    EXPECT_EQ(log->counters.cut_off_lines, is_last_there || is_empty ? 0U : 1U) << length;
  }
  EXPECT_EQ(parse(whole).frames.size(), 2U);  // a missing line end alone is no damage
  // With a line end it was written like that; and what has no frame at all is no log.
  EXPECT_FALSE(parse_candump_log("(1.0) can0 001#11\n(1.0) can\n", "f").has_value());
  EXPECT_FALSE(parse_candump_log("(1.0) can", "f").has_value());
}

TEST(CandumpLog, ThousandsOfEqualStampsKeepTheirOrder) {
  std::string text;
  for (int i = 0; i < 5'000; ++i) {
    char line[64];
    std::snprintf(line, sizeof line, "(7.000000) can0 %08X#\n", static_cast<unsigned>(i));
    text += line;
  }
  const auto log = parse(text);
  ASSERT_EQ(log.frames.size(), 5'000U);
  for (std::uint32_t i = 0; i < 5'000; ++i) ASSERT_EQ(log.frames[i].frame.id, i);
  EXPECT_EQ(log.counters.backward_stamps, 0U);
}

LoggedFrame any_frame(std::mt19937_64& random) {
  constexpr std::uint8_t kFdLengths[] = {0, 5, 8, 12, 16, 20, 24, 32, 48, 64};
  LoggedFrame f;
  f.at = {static_cast<std::int64_t>(random() % 9'000'000'000U) * kNanosecondsPerSecond +
          static_cast<std::int64_t>(random() % 1'000'000'000U)};
  if (random() % 2 == 0) f.at.ns -= f.at.ns % 1'000;
  f.frame.extended = random() % 2 == 0;
  f.frame.fd = random() % 3 == 0;
  f.frame.remote = !f.frame.fd && random() % 4 == 0;
  f.fd_flags = f.frame.fd ? static_cast<std::uint8_t>(random() % 16) : std::uint8_t{0};
  f.frame.id = static_cast<std::uint32_t>(random()) &
               (f.frame.extended ? can::kMaxExtendedId : can::kMaxStandardId);
  f.frame.length = f.frame.fd ? kFdLengths[random() % 10] : static_cast<std::uint8_t>(random() % 9);
  if (!f.frame.remote)
    for (std::size_t k = 0; k < f.frame.length; ++k)
      f.frame.data[k] = static_cast<std::uint8_t>(random());
  f.channel = static_cast<std::uint8_t>(random() % 3);
  f.direction = static_cast<LoggedDirection>(random() % 3);
  return f;
}

TEST(CandumpLog, WrittenAndReadIsIdentity) {
  std::mt19937_64 random(21);
  for (const std::string line_end : {"\n", "\r\n"}) {
    CandumpLog wanted;
    wanted.channels = {"can0", "vcan_1", "x"};
    std::string text;
    for (std::size_t i = 0; i < 10'000; ++i) {
      LoggedFrame f = any_frame(random);
      if (i < 3) f.channel = static_cast<std::uint8_t>(i);
      wanted.frames.push_back(f);
      text += to_candump_line(f, wanted.channels[f.channel]) + line_end;
    }
    const auto log = parse(text);
    EXPECT_EQ(log.channels, wanted.channels);
    ASSERT_EQ(log.frames.size(), wanted.frames.size());
    for (std::size_t i = 0; i < wanted.frames.size(); ++i)
      ASSERT_EQ(log.frames[i], wanted.frames[i])
          << to_candump_line(wanted.frames[i], wanted.channels[wanted.frames[i].channel]);
  }
}

TEST(CandumpLog, AnyTextIsALogOrAProblemNeverMore) {
  std::mt19937_64 random(22);
  const std::string good = "(1398128223.803317) can0 166##1D0320009 T\n";
  constexpr std::string_view kLetters = "()#.R_ T0123456789ABCDEFabcXcan\n\r\t";
  for (int i = 0; i < 50'000; ++i) {
    std::string text = good + good;
    for (std::size_t k = random() % 6; k > 0; --k)
      text[random() % text.size()] = kLetters[random() % kLetters.size()];
    text.resize(random() % (text.size() + 1));
    const auto log = parse_candump_log(text, "f");
    if (!log) {
      ASSERT_TRUE(log.error().place.starts_with("f:"));
    }
  }
}

}  // namespace
}  // namespace pitwall::replay
