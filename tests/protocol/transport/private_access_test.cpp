// SPDX-License-Identifier: Apache-2.0
#include "protocol/transport/private_access.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>

#include "protocol/transport/file.hpp"

namespace pitwall::transport {
namespace {

namespace fs = std::filesystem;

constexpr unsigned kFile = S_IFREG, kFolder = S_IFDIR;
constexpr unsigned kRoot = 0, kAlice = 1000, kBob = 1001;

TEST(PrivateAccess, AFileIsItsUsersAlone) {
  for (const unsigned mode : {0600U, 0400U, 0700U}) {
    EXPECT_FALSE(judge_file("k", {kAlice, kFile | mode}, kAlice)) << std::oct << mode;
    EXPECT_FALSE(judge_file("k", {kRoot, kFile | mode}, kRoot)) << std::oct << mode;
  }
  for (const unsigned mode :
       {0640U, 0620U, 0610U, 0604U, 0602U, 0601U, 0440U, 0660U, 0644U, 0666U, 0777U}) {
    for (const unsigned user : {kAlice, kRoot}) {
      const auto problem = judge_file("k", {user, kFile | mode}, user);
      ASSERT_TRUE(problem) << std::oct << mode;
      EXPECT_EQ(problem->place, "k");
    }
  }
  EXPECT_EQ(judge_file("a/k", {kAlice, kFile | 0644U}, kAlice)->what,
            "has mode 0644, so others may read or change it, expected 0600: chmod 600 a/k, and "
            "replace the secret");
}

TEST(PrivateAccess, AFileOfAnotherUserIsRefusedWhateverItsMode) {
  for (const unsigned mode : {0600U, 0400U, 0644U}) {
    EXPECT_TRUE(judge_file("k", {kBob, kFile | mode}, kAlice));
    EXPECT_TRUE(judge_file("k", {kBob, kFile | mode}, kRoot)) << "root reads everything";
  }
  EXPECT_EQ(
      judge_file("k", {kBob, kFile | 0600U}, kAlice)->what,
      "belongs to user 1001, expected user 1000, who runs this program, or root: chown 1000 k");
  EXPECT_EQ(judge_file("k", {kBob, kFile | 0600U}, kRoot)->what,
            "belongs to user 1001, expected user 0, who runs this program: chown 0 k");
}

// As systemd hands over a credential: root's, readable through an ACL that shows as the group's.
TEST(PrivateAccess, RootMayLetAGroupRead) {
  EXPECT_FALSE(judge_file("k", {kRoot, kFile | 0440U}, kAlice));
  EXPECT_FALSE(judge_file("k", {kRoot, kFile | 0640U}, kAlice));
  for (const unsigned mode : {0660U, 0460U, 0644U, 0604U, 0602U, 0650U})
    EXPECT_TRUE(judge_file("k", {kRoot, kFile | mode}, kAlice)) << std::oct << mode;
}

TEST(PrivateAccess, InAFolderNobodyElseMayReplaceIt) {
  for (const unsigned mode : {0700U, 0755U, 0750U, 01777U, 01770U}) {
    EXPECT_FALSE(judge_folder("f", {kAlice, kFolder | mode}, kAlice)) << std::oct << mode;
    EXPECT_FALSE(judge_folder("f", {kRoot, kFolder | mode}, kAlice)) << std::oct << mode;
    EXPECT_TRUE(judge_folder("f", {kBob, kFolder | mode}, kAlice)) << std::oct << mode;
  }
  for (const unsigned mode : {0770U, 0775U, 0707U, 0777U})
    EXPECT_TRUE(judge_folder("f", {kAlice, kFolder | mode}, kAlice)) << std::oct << mode;
  EXPECT_EQ(judge_folder("f", {kAlice, kFolder | 0777U}, kAlice)->what,
            "folder has mode 0777, so others may replace its files, expected 0755 or less: "
            "chmod go-w f");
}

class PrivateFile : public ::testing::Test {
 protected:
  PrivateFile() { EXPECT_TRUE(write_private_file(key_, "secret")); }
  std::string refusal(const std::string& path) const {
    const auto opened = open_private(path);
    return opened ? "" : to_string(opened.error());
  }

  TemporaryFolder folder_ = *TemporaryFolder::create("pitwall-private-");
  std::string key_ = folder_.path() + "/key";
};

TEST_F(PrivateFile, IsOpenedWhereItIsItsUsersAlone) {
  EXPECT_EQ(refusal(key_), "");
  fs::permissions(key_, fs::perms{0640});
  EXPECT_NE(refusal(key_).find("has mode 0640"), std::string::npos) << refusal(key_);
}

TEST_F(PrivateFile, IsNoLink) {
  const std::string link = folder_.path() + "/link";
  fs::create_symlink(key_, link);
  EXPECT_NE(refusal(link).find("is a symbolic link"), std::string::npos) << refusal(link);
  EXPECT_NE(refusal(link).find(link), std::string::npos);
}

TEST_F(PrivateFile, IsAFileThatIsThere) {
  EXPECT_NE(refusal(folder_.path()).find("expected a file"), std::string::npos);
  EXPECT_NE(refusal("/dev/zero").find("expected a file"), std::string::npos);
  ASSERT_EQ(mkfifo((folder_.path() + "/pipe").c_str(), 0600), 0);
  EXPECT_NE(refusal(folder_.path() + "/pipe").find("expected a file"), std::string::npos);
  EXPECT_NE(refusal(folder_.path() + "/none").find("No such file"), std::string::npos);
}

TEST_F(PrivateFile, IsNotReadOrWrittenWhereOthersMayReplaceIt) {
  fs::permissions(folder_.path(), fs::perms{0777});
  EXPECT_NE(refusal(key_).find(folder_.path() + ": error: folder has mode 0777"), std::string::npos)
      << refusal(key_);
  EXPECT_FALSE(write_private_file(folder_.path() + "/new", "secret"));
  EXPECT_FALSE(fs::exists(folder_.path() + "/new"));
  fs::permissions(folder_.path(), fs::perms{01777});
  EXPECT_EQ(refusal(key_), "") << "nobody else may rename what is in a sticky folder";
}

TEST_F(PrivateFile, WithoutAFolderLiesInTheCurrentOne) {
  const auto before = fs::current_path();
  fs::current_path(folder_.path());
  EXPECT_EQ(refusal("key"), "");
  fs::permissions(folder_.path(), fs::perms{0777});
  EXPECT_NE(refusal("key").find(".: error: folder has mode 0777"), std::string::npos);
  fs::current_path(before);
}

}  // namespace
}  // namespace pitwall::transport
