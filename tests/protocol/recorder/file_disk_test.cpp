// SPDX-License-Identifier: Apache-2.0
#include "protocol/recorder/file_disk.hpp"

#include <gtest/gtest.h>

#include <array>
#include <filesystem>

#include "protocol/transport/file.hpp"
#include "tests/support/comes_true.hpp"

namespace pitwall::recorder {
namespace {

constexpr std::array<std::uint8_t, 3> kBytes{'a', 'b', 'c'};

TEST(FileDisk, AFileIsThereAtOnceAndItsSyncComesByItself) {
  const auto folder = transport::TemporaryFolder::create("pitwall_disk");
  FileDisk disk{folder->path() + "/made/here"};
  ASSERT_FALSE(disk.check());
  ASSERT_FALSE(disk.begin("x.mcap"));
  ASSERT_TRUE(disk.append(kBytes));
  const std::string path = folder->path() + "/made/here/x.mcap";
  EXPECT_EQ(*transport::read_file(path), "abc");
  EXPECT_TRUE(is_being_written(path));
  const std::uint64_t before = disk.syncs();
  EXPECT_TRUE(pitwall::testing::comes_true([&] { return disk.syncs() > before; }));
  EXPECT_EQ(disk.failed_syncs(), 0U);
  disk.end(true);
  EXPECT_FALSE(is_being_written(path));
  EXPECT_FALSE(disk.append(kBytes));
  EXPECT_GT(disk.free_bytes(), 0U);
}

TEST(FileDisk, WhatIsNotKeptIsGone) {
  const auto folder = transport::TemporaryFolder::create("pitwall_disk");
  FileDisk disk{folder->path()};
  ASSERT_FALSE(disk.begin("x.mcap"));
  disk.end(false);
  EXPECT_FALSE(std::filesystem::exists(folder->path() + "/x.mcap"));
}

TEST(FileDisk, AFolderThatCannotBeIsToldWithItsPath) {
  const auto folder = transport::TemporaryFolder::create("pitwall_disk");
  ASSERT_TRUE(transport::write_file(folder->path() + "/file", "x"));
  FileDisk disk{folder->path() + "/file/sub"};
  const auto problem = disk.check();
  ASSERT_TRUE(problem);
  EXPECT_NE(problem->place.find("/file/sub"), std::string::npos);
  EXPECT_TRUE(disk.begin("x.mcap"));
}

}  // namespace
}  // namespace pitwall::recorder
