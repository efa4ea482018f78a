// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/recordings/recording_folder.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "protocol/recorder/segment_folder.hpp"
#include "tests/hil/bench/recorded/recorded_drive.hpp"

namespace pitwall::cli {
namespace {

TEST(RecordingFolder, AFolderIsReadAsItsSegmentsOneAfterTheOther) {
  const std::string file = recorder::segments_of(bench::recorded_folder())->front();
  const auto one = read_traffic(file);
  ASSERT_TRUE(one) << to_string(one.error());
  EXPECT_GT(one->records.size(), bench::kDrivenTicks);
  const auto folder = *transport::TemporaryFolder::create("pitwall-folder-");
  for (const char* name : {"/a.mcap", "/b.mcap"})
    std::filesystem::copy_file(file, folder.path() + name);
  const auto both = read_traffic(folder.path());
  ASSERT_TRUE(both) << to_string(both.error());
  EXPECT_EQ(both->records.size(), 2 * one->records.size());
  EXPECT_EQ(both->sources.size(), one->sources.size()) << "they go on in the same ones";
}

TEST(RecordingFolder, WhatHoldsNoRecordingIsAProblemThatNamesIt) {
  const auto folder = *transport::TemporaryFolder::create("pitwall-folder-");
  const auto empty = read_traffic(folder.path());
  ASSERT_FALSE(empty);
  EXPECT_EQ(empty.error().place, folder.path());
  ASSERT_FALSE(read_traffic("/nowhere"));
}

}  // namespace
}  // namespace pitwall::cli
