// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/writers/asc_writer.hpp"

#include <gtest/gtest.h>

#include "hil/replay/formats/asc.hpp"
#include "hil/replay/writers/log_writer.hpp"
#include "tests/hil/replay/formats/log_oracle.hpp"
#include "tests/hil/replay/formats/made_log.hpp"

namespace pitwall::replay {
namespace {

TEST(AscWriter, PythonCanReadsTheSameFrames) {
  const auto folder = transport::TemporaryFolder::create("pitwall-asc-");
  ASSERT_TRUE(folder);
  const CanLog log = make_log({.frames = 500});
  const std::string path = folder->path() + "/a.asc";
  ASSERT_TRUE(transport::write_file(path, to_asc(log, channel_numbers_of(log))));
  oracle::expect_same(log, oracle::read("asc", path, folder->path()), {});
}

TEST(AscWriter, ALogWithoutFramesIsOneThatReads) {
  const auto read = read_asc(to_asc({}, {}), "a.asc");
  ASSERT_TRUE(read);
  EXPECT_TRUE(read->frames.empty() && read->remarks.empty());
}

}  // namespace
}  // namespace pitwall::replay
