// A public file is read beside python-can in log_reader_test.cpp. Lines after PEAK's description.
// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/formats/trc.hpp"

#include <gtest/gtest.h>

#include "tests/hil/replay/formats/log_oracle.hpp"
#include "tests/hil/replay/formats/made_log.hpp"

namespace pitwall::replay {
namespace {

CanLog parse_trc(const std::string& text) {
  auto log = read_trc(text, "f.trc");
  EXPECT_TRUE(log.has_value()) << (log ? "" : to_string(log.error()));
  return log ? *std::move(log) : CanLog{};
}

constexpr std::int64_t kNoon_ns = 1'639'828'800'000'000'000;  // 2021-12-18 12:00 UTC, day 44548.5

// Of every version the same three frames.
void expect_three(const CanLog& log, std::int64_t zero_ns) {
  ASSERT_EQ(log.frames.size(), 3U) << to_text(log, "f");
  EXPECT_TRUE(log.remarks.empty()) << to_text(log, "f");
  const auto& f = log.frames;
  EXPECT_EQ(f[0].at.ns, zero_ns + 1'059'000'000);
  EXPECT_EQ(f[0].frame.id, 0x300U);
  EXPECT_FALSE(f[0].frame.extended);
  EXPECT_EQ(f[0].frame.length, 2);
  EXPECT_EQ(f[0].frame.data[1], 0x22);
  EXPECT_EQ(f[1].frame.id, 0x18EFC034U);
  EXPECT_TRUE(f[1].frame.extended);
  EXPECT_TRUE(f[2].frame.remote);
  EXPECT_EQ(f[2].frame.length, 4);
}

TEST(Trc, EveryVersionIsRead) {
  const std::string start = ";$STARTTIME=44548.5\n";
  expect_three(
      parse_trc(";##########\n;   C:\\a.trc\n;\n;    Start time: 18.12.2021 12:00:00.000.0\n"
                ";----+--   ----+----\n"
                "     1)      1059 0300 2  11 22\n     2)      1060 18EFC034 0\n"
                "     3)      1061 0704 4  RTR\n     4)      1062 FFFFFFFF 4  00 00 00 08 "
                "BUSHEAVY\n"),
      kNoon_ns);
  expect_three(parse_trc(";$FILEVERSION=1.1\n" + start +
                         "     1)      1059.0  Rx         0300  2  11 22 \n"
                         "     2)      1060.5  Tx     18EFC034  0 \n"
                         "     3)      1061.5  Rx         0704  4  RTR\n"
                         "     4)      1062.5  Warng  FFFFFFFF  4  00 00 00 08  BUSHEAVY \n"),
               kNoon_ns);
  expect_three(parse_trc(";$FILEVERSION=1.2\n" + start +
                         "     1)      1059.000 1  Rx         0300  2  11 22 \n"
                         "     2)      1060.500 2  Tx     18EFC034  0 \n"
                         "     3)      1061.500 1  Rx         0704  4  RTR\n"),
               kNoon_ns);
  expect_three(parse_trc(";$FILEVERSION=1.3\n" + start +
                         "     1)      1059.000 1  Rx        0300 -  2    11 22 \n"
                         "     2)      1060.500 2  Tx    18EFC034 -  0 \n"
                         "     3)      1061.500 1  Rx        0704 -  4    RTR\n"),
               kNoon_ns);
  expect_three(parse_trc(";$FILEVERSION=2.0\n" + start +
                         ";$COLUMNS=N,O,T,I,d,l,D\n"
                         "      1      1059.000 DT     0300 Rx 2  11 22 \n"
                         "      2      1060.500 DT 18EFC034 Tx 0 \n"
                         "      3      1061.500 RR     0704 Rx 4 \n"
                         "      4      1062.500 ST          Rx    00 00 00 08\n"),
               kNoon_ns);
  expect_three(parse_trc(";$FILEVERSION=2.1\n" + start +
                         ";$COLUMNS=N,O,T,B,I,d,R,L,D\n"
                         "      1      1059.000 DT 1      0300 Rx -  2    11 22 \n"
                         "      2      1060.500 DT 2  18EFC034 Tx -  0 \n"
                         "      3      1061.500 RR 1      0704 Rx -  4 \n"),
               kNoon_ns);
}

TEST(Trc, FdTypesCarryTheirFlags) {
  const auto log = parse_trc(
      ";$FILEVERSION=2.1\n"
      "      1      1.000 FD 1      0300 Rx -  9    01 02 03 04 05 06 07 08 09 0A 0B 0C \n"
      "      2      2.000 FB 1      0300 Rx -  1    01 \n"
      "      3      3.000 FE 1      0300 Rx -  1    01 \n"
      "      4      4.000 BI 1      0300 Rx -  1    01 \n"
      "      5      5.000 ER 1         - Rx -  5    04 00 02 00 00 \n");
  ASSERT_EQ(log.frames.size(), 4U) << to_text(log, "f");
  EXPECT_EQ(log.frames[0].frame.length, 12);
  EXPECT_EQ(log.frames[1].fd_flags, kFdBitRateSwitch);
  EXPECT_EQ(log.frames[2].fd_flags, kFdErrorState);
  EXPECT_EQ(log.frames[3].fd_flags, kFdBitRateSwitch | kFdErrorState);
  EXPECT_EQ(log.counters.error_frames, 1U);
}

TEST(Trc, FilesOfPythonCanAreReadBack) {
  const auto folder = transport::TemporaryFolder::create("pitwall-trc-");
  ASSERT_TRUE(folder);
  const CanLog log = make_log({.frames = 300, .fd = false, .remote = false});
  const std::string path = folder->path() + "/a.trc";
  oracle::write("trc", path, log, folder->path());
  const CanLog read = parse_trc(*transport::read_file(path));
  EXPECT_TRUE(read.remarks.empty()) << to_text(read, "a.trc");
  ASSERT_EQ(read.frames.size(), log.frames.size());
  for (std::size_t i = 0; i < log.frames.size(); ++i) {
    EXPECT_EQ(read.frames[i].frame, log.frames[i].frame) << i;
    EXPECT_EQ(read.frames[i].direction, log.frames[i].direction) << i;
    EXPECT_NEAR(static_cast<double>(read.frames[i].at.ns - read.frames[0].at.ns),
                static_cast<double>(log.frames[i].at.ns - log.frames[0].at.ns), 1'500.0);
  }
}

TEST(Trc, ABadLineIsLeftOutAndToldWithLineAndColumn) {
  const std::vector<std::pair<std::string, std::size_t>> cases{
      {"x", 1},
      {"2 1.0 Rx 0300 0", 2},
      {"2) x Rx 0300 0", 4},
      {"2) 1.0 Zx 0300 0", 8},
      {"2) 1.0 Rx 0800 0", 11},
      {"2) 1.0 Rx 20000000 0", 11},
      {"2) 1.0 Rx 0300 9 01", 16},
      {"2) 1.0 Rx 0300 2 01", 20},
      {"2) 1.0 Rx 0300 1 01 02", 21},
      {"2) 1.0 Rx 0300 1 012", 20},
      {";$STARTTIME=1.0", 16},
      {";$FILEVERSION=7.1", 1},
      {";$COLUMNS=N,O,T,I,l,D,X", 1},  // a column that nobody knows
      {";$COLUMNS=N,O,T,I,l,L,D", 1},
      {";$COLUMNS=N,O,T,I,d,d,l,D", 1},
      {";$COLUMNS=N,O,T,I,l", 1},  // no data
      {";$COLUMNS=N,O,T,I,D", 1},  // no length
  };
  for (const auto& [text, column] : cases) {
    const auto log =
        parse_trc(";$FILEVERSION=1.1\n 1) 1.0 Rx 0001 0\n" + text + "\n 3) 1.0 Rx 0002 0\n");
    ASSERT_EQ(log.remarks.size(), 1U) << text;
    EXPECT_EQ(log.remarks[0].place, "f.trc:3:" + std::to_string(column))
        << text << ": " << log.remarks[0].what;
    EXPECT_EQ(log.frames.size(), 2U) << text;
  }
}

TEST(Trc, ACutTailIsToldAndNotSent) {
  const auto log = parse_trc(";$FILEVERSION=1.1\n 1) 1.0 Rx 0001 0\n 2) 1.0 Rx 0001 0");
  EXPECT_EQ(log.frames.size(), 1U);
  EXPECT_EQ(log.counters.cut_tails, 1U);
}

}  // namespace
}  // namespace pitwall::replay
