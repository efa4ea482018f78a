// python-can reads the classic data frames of TRC 2.1 only; the other rows are compared with lines
// after PEAK's description.
// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/writers/trc_writer.hpp"

#include <gtest/gtest.h>

#include "hil/replay/formats/trc.hpp"
#include "hil/replay/writers/log_writer.hpp"
#include "tests/hil/replay/formats/log_oracle.hpp"
#include "tests/hil/replay/formats/made_log.hpp"

namespace pitwall::replay {
namespace {

TEST(TrcWriter, PythonCanReadsTheSameFrames) {
  const auto folder = transport::TemporaryFolder::create("pitwall-trc-");
  ASSERT_TRUE(folder);
  const CanLog log = make_log({.frames = 500, .fd = false, .remote = false});
  const std::string path = folder->path() + "/a.trc";
  ASSERT_TRUE(transport::write_file(path, to_trc(log, channel_numbers_of(log))));
  const auto theirs = oracle::read("trc", path, folder->path());
  ASSERT_EQ(theirs.size(), log.frames.size());
  oracle::expect_same(log, theirs, {.relative = true, .first_channel = 1});
}

TEST(TrcWriter, RowsAreAsPeakDescribesThem) {
  CanLog log;
  log.channels = {"can0", "can2"};
  const std::int64_t noon_ns = 1'639'828'800'000'000'000;  // 2021-12-18 12:00 UTC, day 44548.5
  const auto add = [&](std::int64_t at_ns, std::uint32_t id, std::uint8_t length) -> LoggedFrame& {
    log.frames.push_back({.at = {noon_ns + at_ns}, .frame = {.id = id, .length = length}});
    for (std::uint8_t i = 0; i < length; ++i) log.frames.back().frame.data[i] = i;
    return log.frames.back();
  };
  add(0, 0x300, 2).direction = LoggedDirection::kReceived;
  add(1'500'000, 0x18EFC034, 0).frame.extended = true;
  LoggedFrame& remote = add(2'500'000, 0x704, 0);
  remote.frame.remote = true, remote.frame.length = 4;
  remote.direction = LoggedDirection::kTransmitted;
  const char* const types[] = {"FD", "FB", "FE", "BI"};
  for (std::uint8_t flags = 0; flags < 4; ++flags) {
    LoggedFrame& fd = add(3'000'001, 0x1, 12);
    fd.frame.fd = true, fd.fd_flags = flags, fd.channel = 1;
  }
  const std::string text = to_trc(log, channel_numbers_of(log));
  EXPECT_NE(text.find(";$FILEVERSION=2.1\r\n;$STARTTIME=44548.500000000000000\r\n"
                      ";$COLUMNS=N,O,T,B,I,d,R,L,D\r\n"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find(";   Start time: 18.12.2021 12:00:00.000.0\r\n"), std::string::npos);
  std::string rows =
      "      1         0.000 DT  1     0300 Rx -  2    00 01\r\n"
      "      2         1.500 DT  1 18EFC034 Rx -  0   \r\n"
      "      3         2.500 RR  1     0704 Tx -  4   \r\n";
  for (std::size_t i = 0; i < 4; ++i)
    rows += "      " + std::to_string(i + 4) + "      3.000001 " + types[i] +
            "  3     0001 Rx -  9    00 01 02 03 04 05 06 07 08 09 0A 0B\r\n";
  EXPECT_TRUE(text.ends_with("\r\n" + rows)) << text;
}

TEST(TrcWriter, ALogWithoutFramesIsOneThatReads) {
  const auto read = read_trc(to_trc({}, {}), "a.trc");
  ASSERT_TRUE(read);
  EXPECT_TRUE(read->frames.empty() && read->remarks.empty());
}

}  // namespace
}  // namespace pitwall::replay
