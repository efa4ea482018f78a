// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/writers/blf_writer.hpp"

#include <gtest/gtest.h>

#include "hil/replay/formats/blf.hpp"
#include "hil/replay/writers/log_writer.hpp"
#include "tests/hil/replay/formats/made_log.hpp"
#include "tests/hil/replay/formats/tshark_oracle.hpp"

namespace pitwall::replay {
namespace {

// Several containers.
TEST(BlfWriter, PythonCanAndTsharkReadTheSameFrames) {
  const auto folder = transport::TemporaryFolder::create("pitwall-blf-");
  ASSERT_TRUE(folder);
  const CanLog log = make_log({.frames = 6'000});
  const std::string path = folder->path() + "/a.blf";
  const auto bytes = to_blf(log, channel_numbers_of(log));
  ASSERT_TRUE(bytes && transport::write_file(path, *bytes));
  oracle::expect_same(log, oracle::read("blf", path, folder->path()), {});
  oracle::expect_as_tshark(log, path, folder->path(), false);
}

TEST(BlfWriter, ALogWithoutFramesIsOneThatReads) {
  const auto bytes = to_blf({}, {});
  ASSERT_TRUE(bytes);
  const auto read = read_blf(*bytes, "a.blf");
  ASSERT_TRUE(read);
  EXPECT_TRUE(read->frames.empty() && read->remarks.empty());
}

}  // namespace
}  // namespace pitwall::replay
