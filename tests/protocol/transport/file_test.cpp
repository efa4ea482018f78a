// SPDX-License-Identifier: Apache-2.0
#include "protocol/transport/file.hpp"

#include <gtest/gtest.h>

#include <filesystem>

namespace pitwall::transport {
namespace {

class Files : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return folder_.path() + "/" + name; }
  TemporaryFolder folder_ = *TemporaryFolder::create("pitwall-file-");
};

TEST_F(Files, WhatIsWrittenIsRead) {
  std::string contents;
  for (int i = 0; i < 300'000; ++i) contents += static_cast<char>(i * 31);
  for (const std::size_t n : {0UL, 1UL, 65'535UL, 65'536UL, 65'537UL, 300'000UL}) {
    ASSERT_TRUE(write_file(path("f"), contents.substr(0, n)));
    const auto read = read_file(path("f"));
    ASSERT_TRUE(read.has_value());
    EXPECT_EQ(*read, contents.substr(0, n));
  }
  EXPECT_FALSE(std::filesystem::exists(path("f.part")));
}

TEST_F(Files, ProblemsNameThePath) {
  for (const std::string& bad : {path("missing"), folder_.path()}) {
    const auto read = read_file(bad);
    ASSERT_FALSE(read.has_value());
    EXPECT_EQ(read.error().place, bad);
  }
  EXPECT_FALSE(write_file(path("no/such/folder"), "x"));
  ASSERT_TRUE(write_file(path("long"), "123456"));
  EXPECT_FALSE(read_file(path("long"), 5));
  EXPECT_TRUE(read_file(path("long"), 6));
}

TEST_F(Files, AppendsAddUpAcrossOpenings) {
  for (int i = 0; i < 3; ++i) {
    auto writer = AppendWriter::open(path("log"));
    ASSERT_TRUE(writer.has_value());
    ASSERT_TRUE(writer->write("abc"));
    ASSERT_TRUE(writer->sync());
    EXPECT_EQ(writer->counters().bytes, 3U);
    EXPECT_EQ(writer->counters().syncs, 1U);
  }
  EXPECT_EQ(read_file(path("log")).value_or(""), "abcabcabc");
  auto fresh = AppendWriter::open(path("log"), AppendWriter::Start::kTruncate);
  ASSERT_TRUE(fresh.has_value());
  EXPECT_EQ(read_file(path("log")).value_or("?"), "");
}

TEST_F(Files, AFullDiskIsAFailureThatIsCounted) {
  auto full = AppendWriter::open("/dev/full");
  ASSERT_TRUE(full.has_value());
  EXPECT_FALSE(full->write("does not fit"));
  EXPECT_EQ(full->counters().failures, 1U);
  EXPECT_EQ(full->counters().last_error, ENOSPC);
  EXPECT_EQ(full->counters().bytes, 0U);
}

TEST_F(Files, TextGoesToAnOpenDescriptorOrSaysNo) {
  auto writer = AppendWriter::open(path("out"));
  ASSERT_TRUE(writer.has_value());
  EXPECT_TRUE(write_to(writer->fd(), "said"));
  EXPECT_EQ(read_file(path("out")).value_or(""), "said");
  EXPECT_FALSE(write_to(-1, "said"));
}

TEST_F(Files, ASecretIsReadOnlyWhereOthersHaveNoAccess) {
  using std::filesystem::perms;
  ASSERT_TRUE(write_private_file(path("key"), "secret"));
  EXPECT_EQ(std::filesystem::status(path("key")).permissions(), perms(0600));
  EXPECT_EQ(read_private_file(path("key")).value_or(""), "secret");
  EXPECT_FALSE(read_private_file(path("key"), 5));
  std::filesystem::permissions(path("key"), perms(0644));
  const auto read = read_private_file(path("key"));
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().place, path("key"));
  EXPECT_FALSE(read_private_file(path("missing")));
}

TEST_F(Files, ASecretIsNeverReplaced) {
  ASSERT_TRUE(write_private_file(path("key"), "first"));
  const auto again = write_private_file(path("key"), "second");
  ASSERT_FALSE(again);
  EXPECT_EQ(again.error().place, path("key"));
  EXPECT_EQ(read_file(path("key")).value_or(""), "first");
}

TEST(TemporaryFolder, TakesEverythingWithItAndMovesOnce) {
  std::string path;
  {
    auto made = TemporaryFolder::create("pitwall-file-");
    ASSERT_TRUE(made.has_value());
    const TemporaryFolder folder(*std::move(made));
    path = folder.path();
    std::filesystem::create_directories(path + "/a/b");
    ASSERT_TRUE(write_file(path + "/a/b/c", "x"));
  }
  EXPECT_FALSE(std::filesystem::exists(path));
}

TEST(TemporaryFolder, LiesWhereItIsWanted) {
  const auto outer = TemporaryFolder::create("pitwall-file-");
  ASSERT_TRUE(outer);
  const auto inner = TemporaryFolder::create("in-", outer->path());
  ASSERT_TRUE(inner);
  EXPECT_TRUE(inner->path().starts_with(outer->path() + "/in-"));
}

}  // namespace
}  // namespace pitwall::transport
