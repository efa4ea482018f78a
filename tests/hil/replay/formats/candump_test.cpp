// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/formats/candump.hpp"

#include <gtest/gtest.h>

#include <random>

#include "hil/replay/writers/candump_writer.hpp"

namespace pitwall::replay {
namespace {

CanLog parse(const std::string& text) {
  auto log = read_candump(text, "f.log");
  EXPECT_TRUE(log.has_value()) << (log ? "" : to_string(log.error()));
  return log ? *std::move(log) : CanLog{};
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
      "(1.5) can0 0000012a#ff\n");
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

// Each bad text stands between good lines.
TEST(CandumpLog, ABadLineIsLeftOutAndToldWithLineAndColumn) {
  const std::vector<std::pair<std::string, std::size_t>> cases{
      {"x", 2},
      {"1.0) can0 001#", 8},
      {std::string("(1.0) can0 001#\0", 16), 16},
      {std::string("(1.0) ca\0n0 001#1", 18), 18},
      {"(1.0) can0 001#1", 17},
      {"(1.0) can0 " + std::string(100'000, '1'), 20},
      {std::string(100'000, ' ') + "x", 100'002},
      {"(a.0) can0 001#", 2},
      {"(1) can0 001#", 3},
      {"(1.) can0 001#", 4},
      {"(1.0000000001) can0 001#", 13},
      {"(1234567890 1.0) can0 001#", 12},
      {"(9000000001.0) can0 001#", 12},
      {"(1.0 can0 001#", 5},
      {"(1.0)can0 001#", 6},
      {"(1.0) ", 7},
      {"(1.0) an_interface_name_too_long 001#", 7},
      {"(1.0) can0 12#", 14},
      {"(1.0) can0 1234#", 16},
      {"(1.0) can0 800#", 12},
      {"(1.0) can0 123", 15},
      {"(1.0) can0 123#1", 17},
      {"(1.0) can0 123#112233445566778899", 32},
      {"(1.0) can0 123#R9", 17},
      {"(1.0) can0 123#11 X", 19},
      {"(1.0) can0 123#11Z", 18},
      {"(1.0) can0 123##", 17},
      {"(1.0) can0 123##0112233445566778899", 36},
      {"(1.0) can0 123#11_9", 19},
      {"can0 123#11", 1},
      {"(2014-13-22 00:57:03.8) can0 123 [0]", 7},
      {"(1.0) can0 123 [9] 11", 17},
      {"(1.0) can0 123 [2]  11", 23},
      {"(1.0) can0 123 [1]  11 22", 24},
      {"(1.0) can0 123 [2]  11 22   '.'", 31},
      {"(1.0) can0 RX - 123 [0]", 20},
      {"(1.0) can0 123 [2]  1122", 23},
      {"(1.0) can0 123 [0]  remote", 27},
      {"DROPCOUNT: dropped", 13},
  };
  for (const auto& [text, column] : cases) {
    const auto log = parse("(1.0) can0 001#\n" + text + "\n(1.0) can0 002#\n");
    ASSERT_EQ(log.remarks.size(), 1U) << text;
    EXPECT_EQ(log.remarks[0].place, "f.log:2:" + std::to_string(column))
        << text << ": " << log.remarks[0].what;
    EXPECT_FALSE(log.remarks[0].what.empty());
    EXPECT_EQ(log.counters.bad_records, 1U);
    ASSERT_EQ(log.frames.size(), 2U) << text;
    EXPECT_EQ(log.frames[1].frame.id, 2U);
    EXPECT_EQ(log.channels, std::vector<std::string>{"can0"}) << text;
  }
}

TEST(CandumpLog, OfManyBadLinesTheFirstAreListedAndAllAreCounted) {
  std::string text = "(1.0) can0 001#\n";
  for (int i = 0; i < 50; ++i) text += "(1.0) can0 001#1\n";
  const auto log = parse(text);
  EXPECT_EQ(log.counters.bad_records, 50U);
  EXPECT_EQ(log.remarks.size(), kListedRemarks);
  EXPECT_EQ(log.remarks_left_off, 50U - kListedRemarks);
}

TEST(CandumpLog, WhereNothingReadsTheFirstPlaceIsAProblem) {
  const auto log = read_candump("(1.0) can0 001#1\n(1.0) can0 002#1\n", "f.log");
  ASSERT_FALSE(log.has_value());
  EXPECT_EQ(log.error().place, "f.log:1:17");
}

TEST(CandumpLog, MoreInterfacesThanAllowedAreLeftOut) {
  std::string text;
  for (std::size_t i = 0; i <= kMaxChannels; ++i) text += "(1.0) c" + std::to_string(i) + " 001#\n";
  const auto log = parse(text);
  EXPECT_EQ(log.frames.size(), kMaxChannels);
  EXPECT_EQ(log.counters.bad_records, 1U);
}

TEST(CandumpLog, ALastLineWithoutAnEndIsToldAndNotSentWhateverItSays) {
  const std::string whole = "(1.000000) can0 001#11\n(1.000001) can0 002##1AABBCC T";
  const std::size_t first = whole.find('\n') + 1;
  for (std::size_t length = first; length <= whole.size(); ++length) {
    const auto log = parse(whole.substr(0, length));
    ASSERT_EQ(log.frames.size(), 1U) << length;
    ASSERT_EQ(log.counters.cut_tails, length > first ? 1U : 0U) << length;
    ASSERT_EQ(log.remarks.size(), length > first ? 1U : 0U) << length;
  }
  EXPECT_EQ(parse(whole + "\n").frames.size(), 2U);
  EXPECT_EQ(parse(whole + "\r").frames.size(), 2U);
  EXPECT_FALSE(read_candump("(1.0) can0 001#11", "f").has_value());
}

TEST(CandumpLog, EndsOfLinesMayBeMixedAndAMarkMayComeFirst) {
  const auto log =
      parse("\xEF\xBB\xBF# a comment\r(1.0) can0 001#\r\n\n(1.0) can0 002#\r(1.0) can0 003#\n");
  ASSERT_EQ(log.frames.size(), 3U);
  EXPECT_EQ(log.counters.comments, 1U);
  EXPECT_EQ(log.counters.blank_lines, 1U);
  EXPECT_EQ(log.counters.bad_records, 0U);
}

// As sprint_long_canframe() of can-utils prints them.
TEST(CandumpLog, TheConsoleDialectsAreUnderstood) {
  const auto log = parse(
      " (1398128223.803317)  can0  166   [4]  D0 32 00 09\n"
      " (1398128223.803318)  can0  18DAF110   [2]  11 22                     '.\"'\n"
      " (1398128223.803319)  can0  7FF   [0] \n"
      " (1398128223.803320)  can0  7FE   [3]  remote request\n"
      " (1398128223.803321)  can0  TX - -  123   [1]  FF\n"
      " (1398128223.803322)  can0  RX B E  124  [08]  01 02 03 04 05 06 07 08\n"
      " (1398128223.803323)  can0  125   [2]  00010001 11111111\n"
      " (1398128223.803324)  can0  126   [3]  33`22`11\n"
      " (1398128223.803325)  can0  127   {F}  01 02 03 04 05 06 07 08\n"
      " (1398128223.803326)  can0  20000004   [8]  00 04 00 00 00 00 00 00   ERRORFRAME\n"
      "\tcontroller-problem{rx-error-warning}\n"
      " (2014-04-22 00:57:03.803327)  can1  128   [0]\n");
  ASSERT_EQ(log.frames.size(), 10U) << to_text(log, "f");
  const auto& f = log.frames;
  EXPECT_EQ(f[0].at.ns, 1'398'128'223'803'317'000);
  EXPECT_EQ(f[0].frame.data[3], 9);
  EXPECT_TRUE(f[1].frame.extended);
  EXPECT_EQ(f[2].frame.length, 0);
  EXPECT_TRUE(f[3].frame.remote);
  EXPECT_EQ(f[3].frame.length, 3);
  EXPECT_EQ(f[4].direction, LoggedDirection::kTransmitted);
  EXPECT_EQ(f[5].direction, LoggedDirection::kReceived);
  EXPECT_TRUE(f[5].frame.fd);
  EXPECT_EQ(f[5].fd_flags, kFdBitRateSwitch | kFdErrorState);
  EXPECT_EQ(f[6].frame.data[0], 0x11);
  EXPECT_EQ(f[6].frame.data[1], 0xFF);
  EXPECT_EQ(f[7].frame.data[0], 0x11);
  EXPECT_EQ(f[7].frame.data[2], 0x33);
  EXPECT_EQ(f[8].frame.length, 8);
  EXPECT_EQ(f[9].at.ns, 1'398'128'223'803'327'000);  // local time, taken as UTC
  EXPECT_EQ(log.counters.error_frames, 1U);
  EXPECT_EQ(log.counters.other_records, 1U);
  EXPECT_EQ(log.notes.size(), 1U);
}

TEST(CandumpLog, ClassicFramesHaveNoFlagsOfCanFdWhateverTheConsolePrints) {
  const auto log = parse(
      " (1398128223.803317)  can0  RX B E  124   [3]  remote request\n"
      " (1398128223.803318)  can0  RX B E  124   [1]  11\n");
  ASSERT_EQ(log.frames.size(), 2U) << to_text(log, "f");
  EXPECT_EQ(log.frames[0].fd_flags, 0);
  EXPECT_EQ(log.frames[1].fd_flags, 0);
}

TEST(CandumpLog, SmallStampsAreOffsetsOrGaps) {
  std::string offsets, gaps;
  for (int i = 0; i < 20; ++i) {
    char line[64];
    std::snprintf(line, sizeof line, " (000.%06d)  can0  123   [0]\n", i * 1'000);
    offsets += line;
    std::snprintf(line, sizeof line, " (000.%06d)  can0  123   [0]\n", i % 2 == 0 ? 1'000 : 500);
    gaps += line;
  }
  const auto by_offset = parse(offsets), by_gap = parse(gaps);
  EXPECT_EQ(by_offset.frames.back().at.ns, 19'000'000);
  EXPECT_EQ(by_gap.frames.back().at.ns, 15'000'000);
  EXPECT_EQ(by_gap.counters.backward_stamps, 0U);
  EXPECT_NE(by_gap.notes.at(0).find("-td"), std::string::npos);
  EXPECT_NE(by_offset.notes.at(0).find("-tz"), std::string::npos);
}

TEST(CandumpLog, FramesWithoutAStampKeepTheirOrderAtTimeZero) {
  const auto log = parse("  can0  123   [1]  11\n  can0  124   [1]  22\n");
  ASSERT_EQ(log.frames.size(), 2U);
  EXPECT_EQ(log.frames[1].at.ns, 0);
  EXPECT_EQ(log.notes.size(), 1U);
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
    CanLog wanted;
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
    const auto log = read_candump(text, "f");
    if (!log) {
      ASSERT_TRUE(log.error().place.starts_with("f:"));
    } else {
      ASSERT_EQ(log->remarks.size(), log->counters.bad_records + log->counters.cut_tails);
    }
  }
}

}  // namespace
}  // namespace pitwall::replay
