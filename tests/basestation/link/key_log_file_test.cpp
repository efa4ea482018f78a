// SPDX-License-Identifier: Apache-2.0
#include "basestation/link/key_log_file.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "protocol/transport/file.hpp"

namespace pitwall::link {
namespace {

telemetry::KeyFile keys_of_the_bench() {
  telemetry::KeyFile keys;
  keys.bench = true;
  return keys;
}

TEST(KeyLogFile, KeysOfARealCarAreNeverLaidOpen) {
  const auto folder = transport::TemporaryFolder::create("key_log");
  ASSERT_TRUE(folder);
  const auto refused = key_log_to(folder->path() + "/keys", {});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().place, "--key-log");
  EXPECT_NE(refused.error().what.find("keygen --bench"), std::string::npos);
  EXPECT_FALSE(transport::read_file(folder->path() + "/keys"));
}

TEST(KeyLogFile, EachSessionIsAppendedToAFileOfItsOwnerOnly) {
  const auto folder = transport::TemporaryFolder::create("key_log");
  ASSERT_TRUE(folder);
  const std::string path = folder->path() + "/keys";
  for (const char* const session : {"one\n", "two\n"}) {
    const auto log = key_log_to(path, keys_of_the_bench());
    ASSERT_TRUE(log) << to_string(log.error());
    (*log)(session);
  }
  EXPECT_EQ(*transport::read_file(path), "one\ntwo\n");
  struct stat about {};
  ASSERT_EQ(stat(path.c_str(), &about), 0);
  EXPECT_EQ(about.st_mode & 0777U, 0600U);
}

TEST(KeyLogFile, AFileThatOthersMayReadIsRefused) {
  const auto folder = transport::TemporaryFolder::create("key_log");
  ASSERT_TRUE(folder);
  const std::string path = folder->path() + "/keys";
  ASSERT_TRUE(transport::write_file(path, ""));
  ASSERT_EQ(chmod(path.c_str(), 0644), 0);
  EXPECT_FALSE(key_log_to(path, keys_of_the_bench()));
}

}  // namespace
}  // namespace pitwall::link
