// The public files are read beside python-can in log_reader_test.cpp.
// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/formats/asc.hpp"

#include <gtest/gtest.h>

#include "tests/hil/replay/formats/log_oracle.hpp"
#include "tests/hil/replay/formats/made_log.hpp"

namespace pitwall::replay {
namespace {

const std::string kHeader =
    "date Sat Sep 30 15:06:13.191 2017\nbase hex  timestamps absolute\ninternal events logged\n";

CanLog parse_asc(const std::string& text) {
  auto log = read_asc(text, "f.asc");
  EXPECT_TRUE(log.has_value()) << (log ? "" : to_string(log.error()));
  return log ? *std::move(log) : CanLog{};
}

constexpr std::int64_t kZero_ns = 1'506'783'973'191'000'000;  // date -u -d '2017-09-30 15:06:13'

TEST(Asc, FilesOfPythonCanAreReadBack) {
  const auto folder = transport::TemporaryFolder::create("pitwall-asc-");
  ASSERT_TRUE(folder);
  const CanLog log = make_log({.frames = 500});
  const std::string path = folder->path() + "/a.asc";
  oracle::write("asc", path, log, folder->path(), 7);
  const CanLog read = parse_asc(*transport::read_file(path));
  EXPECT_TRUE(read.remarks.empty()) << to_text(read, "a.asc");
  EXPECT_EQ(read.counters.error_frames, 7U);
  ASSERT_EQ(read.frames.size(), log.frames.size());
  for (std::size_t i = 0; i < log.frames.size(); ++i) {
    EXPECT_EQ(read.frames[i].frame, log.frames[i].frame) << i;
    EXPECT_EQ(read.frames[i].fd_flags, log.frames[i].fd_flags) << i;
    EXPECT_EQ(read.frames[i].direction, log.frames[i].direction) << i;
    EXPECT_EQ(read.channels[read.frames[i].channel], log.channels[log.frames[i].channel]);
    EXPECT_NEAR(static_cast<double>(read.frames[i].at.ns - read.frames[0].at.ns),
                static_cast<double>(log.frames[i].at.ns - log.frames[0].at.ns), 1'000.0);
  }
}

TEST(Asc, DatesOfBothLanguagesAndBothClocksAreRead) {
  for (const std::string date :
       {"Sat Sep 30 15:06:13.191 2017", "Sam Sep 30 15:06:13,191 2017",
        "Sat Sep 30 03:06:13.191 pm 2017", "Sat Sep 30 03:06:13.191 PM 2017"}) {
    const auto log =
        parse_asc("date " + date + "\nbase hex\n 1.000000 1  1 Rx d 0\n 2,500000 1  1 Rx d 0\n");
    ASSERT_EQ(log.frames.size(), 2U) << date;
    EXPECT_EQ(log.frames[0].at.ns, kZero_ns + 1'000'000'000) << date;
    EXPECT_EQ(log.frames[1].at.ns, kZero_ns + 2'500'000'000) << date;
  }
  const auto march = parse_asc("date Mit M\xC3\xA4r 1 00:00:00 2017\nbase hex\n 0.0 1  1 Rx d 0\n");
  EXPECT_EQ(march.frames.at(0).at.ns, 1'488'326'400'000'000'000);
}

TEST(Asc, BaseDecAndRelativeStampsAreFollowed) {
  const auto log = parse_asc(
      "base dec  timestamps relative\n 1.0 1  100 Tx d 2 10 255\n"
      " 0.5 CAN 1 Status:chip status error active\n 0.5 2  2047 Rx d 0\n");
  ASSERT_EQ(log.frames.size(), 2U) << to_text(log, "f");
  EXPECT_EQ(log.frames[0].frame.id, 100U);
  EXPECT_EQ(log.frames[0].frame.data[1], 255);
  EXPECT_EQ(log.frames[1].at.ns, 2'000'000'000);
  EXPECT_EQ(log.counters.other_records, 1U);
}

TEST(Asc, ClassicFramesOnAnFdChannelStayClassic) {
  const auto log =
      parse_asc(kHeader +
                " 1.0 CANFD   1 Rx 300 Name 1 0 2  2 01 02   102203  133   303000 0 0 0 0 0\n"
                " 1.0 CANFD   1 Rx 300 0 0 2  2 01 02   102203  133   200000 0 0 0 0 0\n"
                " 1.0 CANFD   1 Rx 300 0 0 5  0   102203  133   200050 0 0 0 0 0\n"
                " 1.0 CANFD   1 Rx 300 0 0 9 12 01 02 03 04 05 06 07 08 09 0A 0B 0C\n");
  ASSERT_EQ(log.frames.size(), 4U) << to_text(log, "f");
  EXPECT_TRUE(log.frames[0].frame.fd);
  EXPECT_EQ(log.frames[0].fd_flags, kFdBitRateSwitch);
  EXPECT_FALSE(log.frames[1].frame.fd);
  EXPECT_TRUE(log.frames[2].frame.remote);
  EXPECT_EQ(log.frames[2].frame.length, 5);
  EXPECT_EQ(log.frames[3].frame.length, 12);
}

TEST(Asc, ABadLineIsLeftOutAndToldWithLineAndColumn) {
  const std::vector<std::pair<std::string, std::size_t>> cases{
      {"what is this", 1},
      {"date Sat Foo 30 15:06:13.191 2017", 14},
      {"base oct", 9},
      {"1 1  123 Rx d 0", 1},
      {"1.0x 1  123 Rx d 0", 1},
      {"1.0 1  xyz Rx d 0", 8},
      {"1.0 1  800 Rx d 0", 8},
      {"1.0 1  123 Yx d 0", 14},
      {"1.0 1  123 Rx q 0", 16},
      {"1.0 1  123 Rx d 2 01", 21},
      {"1.0 1  123 Rx d 1 01 02", 22},
      {"1.0 1  123 Rx d 1 0102", 19},
      {"1.0 1  123 Rx d 1 01 Length 5", 22},
      {"1.0 1  123 Rx d 1 01 Length = 5 2.0 1  123 Rx d 0", 33},
      {"1.0 1  123 R", 13},
      {"1.0 x  123 Rx d 0", 5},
      {"1.0 CANFD 1 Rx 300 2 0 2 2 01 02", 25},
      {"1.0 CANFD 1 Rx 300 1 0 2 3 01 02 03", 36},
      {"1.0 CANFD 1 Rx 300 1 0 2 2 01 02 7", 35},
      {"1.0 CANFD 1 Rx 300 1 0 2 2 01 02 7 7 10", 40},
  };
  for (const auto& [text, column] : cases) {
    const auto log = parse_asc(kHeader + " 1.0 1  001 Rx d 0\n" + text + "\n 1.0 1  002 Rx d 0\n");
    ASSERT_EQ(log.remarks.size(), 1U) << text;
    EXPECT_EQ(log.remarks[0].place, "f.asc:5:" + std::to_string(column))
        << text << ": " << log.remarks[0].what;
    EXPECT_EQ(log.frames.size(), 2U) << text;
  }
}

TEST(Asc, ACutTailIsToldAndNotSent) {
  const std::string whole = kHeader + " 1.0 1  001 Rx d 1 11\n 1.0 1  002 Rx d 2 11 22";
  EXPECT_EQ(parse_asc(whole).frames.size(), 1U);
  EXPECT_EQ(parse_asc(whole).counters.cut_tails, 1U);
  EXPECT_EQ(parse_asc(whole + "\nEnd TriggerBlock").counters.cut_tails, 0U);
}

}  // namespace
}  // namespace pitwall::replay
