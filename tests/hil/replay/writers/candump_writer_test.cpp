// The way back through our own reader is tested in formats/candump_test.cpp.
// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/writers/candump_writer.hpp"

#include <gtest/gtest.h>

#include "tests/hil/replay/formats/made_log.hpp"
#include "tests/hil/replay/formats/tshark_oracle.hpp"

namespace pitwall::replay {
namespace {

TEST(CandumpWriter, PythonCanReadsTheSameFrames) {
  const auto folder = transport::TemporaryFolder::create("pitwall-candump-");
  ASSERT_TRUE(folder);
  const CanLog log = make_log({.frames = 500});
  const std::string path = folder->path() + "/a.log";
  ASSERT_TRUE(transport::write_file(path, to_candump(log)));
  oracle::expect_same(log, oracle::read("candump", path, folder->path()), {});
}

TEST(CandumpWriter, StampsHaveSixDigitsOrNine) {
  LoggedFrame f;
  f.frame.id = 0x12;
  f.at.ns = 1'500'000'000;
  EXPECT_EQ(to_candump_line(f, "can0"), "(0000000001.500000) can0 012#");
  f.at.ns += 1;
  f.frame.extended = true;
  EXPECT_EQ(to_candump_line(f, "can0"), "(0000000001.500000001) can0 00000012#");
}

}  // namespace
}  // namespace pitwall::replay
