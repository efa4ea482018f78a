// SPDX-License-Identifier: Apache-2.0
#include "protocol/transport/unix_listener.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/socket.h>
#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"

namespace pitwall::transport {
namespace {

constexpr int kBacklog = 8;

TEST(UnixAddress, IsOfAPathThatFits) {
  const std::size_t most = sizeof(sockaddr_un::sun_path) - 1;
  const auto fits = unix_address(std::string(most, 'x'));
  ASSERT_TRUE(fits);
  EXPECT_EQ(fits->sun_path, std::string(most, 'x'));
  for (const std::string& path : {std::string{}, std::string(most + 1, 'x')}) {
    const auto refused = unix_address(path);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().place, path);
    EXPECT_EQ(refused.error().what,
              "expected a path of 1 to 107 bytes, found " + std::to_string(path.size()));
  }
  EXPECT_FALSE(unix_address(std::string{"a\0b", 3}));
}

// Of each type that is in use.
class UnixListeners : public ::testing::TestWithParam<int> {
 protected:
  Result<UnixListener, Problem> open(const std::string& path) const {
    return UnixListener::open(*unix_address(path), GetParam(), kBacklog);
  }
  Result<UnixListener, Problem> open() const { return open(path_); }
  bool is_served() const {
    const FileDescriptor client{unix_socket(GetParam())};
    return connect_to(client, *unix_address(path_)).ok();
  }
  // What a killed program leaves behind: the path without anybody who listens.
  void leave_stale() const {
    {
      const auto killed = open();
      std::filesystem::rename(path_, path_ + ".kept");
    }
    std::filesystem::rename(path_ + ".kept", path_);
  }

  TemporaryFolder folder_ = *TemporaryFolder::create("pitwall-unix-");
  std::string path_ = folder_.path() + "/socket";
};

TEST_P(UnixListeners, AcceptWhoConnects) {
  const auto listener = open();
  ASSERT_TRUE(listener) << to_string(listener.error());
  EXPECT_TRUE(listener->accept().would_block());
  const FileDescriptor client{unix_socket(GetParam())};
  ASSERT_TRUE(connect_to(client, *unix_address(path_)).ok());
  const FileDescriptor server{listener->accept()};
  ASSERT_TRUE(server.valid());
  ASSERT_EQ(::send(client.get(), "abc", 3, 0), 3);
  std::string text(4, ' ');
  EXPECT_EQ(::recv(server.get(), text.data(), text.size(), 0), 3);
}

TEST_P(UnixListeners, ThePathIsItsOwnersAloneAndGoesWithThem) {
  const mode_t before = umask(0);
  {
    const auto listener = open();
    umask(before);
    ASSERT_TRUE(listener) << to_string(listener.error());
    struct stat there {};
    ASSERT_EQ(lstat(path_.c_str(), &there), 0);
    EXPECT_EQ(there.st_mode & 07777U, 0600U);
    EXPECT_TRUE(S_ISSOCK(there.st_mode));
  }
  EXPECT_FALSE(std::filesystem::exists(path_));
}

TEST_P(UnixListeners, APathInUseIsRefusedAndAStaleOneIsReplaced) {
  {
    const auto first = open();
    ASSERT_TRUE(first);
    const auto second = open();
    ASSERT_FALSE(second);
    EXPECT_EQ(second.error().place, path_);
    EXPECT_EQ(second.error().what, "in use");
    EXPECT_TRUE(is_served());
  }
  leave_stale();
  ASSERT_TRUE(std::filesystem::exists(path_));
  EXPECT_FALSE(is_served());
  const auto third = open();
  ASSERT_TRUE(third) << to_string(third.error());
  EXPECT_TRUE(is_served());
}

TEST_P(UnixListeners, FilesOfOthersAreLeftAlone) {
  {
    const auto listener = open();
    ASSERT_TRUE(listener);
    std::filesystem::remove(path_);
    ASSERT_TRUE(write_file(path_, "mine"));
  }
  EXPECT_EQ(*read_file(path_), "mine") << "the path had become another's";
  const auto refused = open();
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().what, "exists and is no socket: left alone");
  EXPECT_EQ(*read_file(path_), "mine");
  EXPECT_FALSE(open(folder_.path()));
  EXPECT_FALSE(open(folder_.path() + "/none/socket"));
}

TEST_P(UnixListeners, OfManyThatStartAtOnceOnAStalePathExactlyOneServes) {
  for (int round = 0; round < 20; ++round) {
    leave_stale();
    std::vector<std::optional<UnixListener>> listeners(6);
    std::vector<std::thread> threads;
    for (auto& slot : listeners)
      threads.emplace_back([&slot, this] {
        if (auto listener = open()) slot.emplace(*std::move(listener));
      });
    for (std::thread& thread : threads) thread.join();
    ASSERT_EQ(std::ranges::count_if(listeners, [](const auto& l) { return l.has_value(); }), 1);
    ASSERT_TRUE(is_served());
  }
}

TEST_P(UnixListeners, NobodyDecidesAboutAPathWhileAnotherHoldsItsFolder) {
  FileDescriptor held(posix_call([&] { return ::open(folder_.path().c_str(), O_RDONLY); }));
  ASSERT_EQ(flock(held.get(), LOCK_EX), 0);
  bool opened = false;
  std::thread starter([&] { opened = open().has_value(); });
  sleep_until(monotonic_now() + milliseconds(50));
  EXPECT_FALSE(std::filesystem::exists(path_));
  held.reset();
  starter.join();
  EXPECT_TRUE(opened);
}

INSTANTIATE_TEST_SUITE_P(Types, UnixListeners, ::testing::Values(SOCK_STREAM, SOCK_SEQPACKET),
                         [](const auto& type) {
                           return type.param == SOCK_STREAM ? "Stream" : "Packets";
                         });

}  // namespace
}  // namespace pitwall::transport
