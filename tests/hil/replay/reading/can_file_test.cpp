// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/reading/can_file.hpp"

#include <gtest/gtest.h>

#include "hil/replay/writers/log_writer.hpp"
#include "protocol/transport/file.hpp"
#include "tests/hil/replay/formats/made_log.hpp"

namespace pitwall::replay {
namespace {

TEST(CanFile, AFileIsReadWithALineOfProgressWhereItIsAskedFor) {
  const auto folder = transport::TemporaryFolder::create("pitwall-can-file-");
  ASSERT_TRUE(folder);
  const std::string path = folder->path() + "/a.blf";
  const CanLog log = make_log({.frames = 100});
  ASSERT_TRUE(transport::write_file(path, write_can_log(log, path)->bytes));
  for (const bool is_asked_for : {false, true}) {
    testing::internal::CaptureStderr();
    const auto read = read_can_file(path, is_asked_for);
    const std::string line = testing::internal::GetCapturedStderr();
    ASSERT_TRUE(read);
    EXPECT_EQ(read->frames, log.frames);
    EXPECT_EQ(line.starts_with("reading " + path + ": "), is_asked_for) << line;
  }
}

TEST(CanFile, WhatCannotBeOpenedIsAProblemWithItsPath) {
  const auto none = read_can_file("/none/such.log", false);
  ASSERT_FALSE(none.has_value());
  EXPECT_EQ(none.error().place, "/none/such.log");
}

}  // namespace
}  // namespace pitwall::replay
