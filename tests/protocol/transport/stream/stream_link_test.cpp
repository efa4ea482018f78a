// SPDX-License-Identifier: Apache-2.0
#include "protocol/transport/stream/stream_link.hpp"

#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <array>
#include <filesystem>
#include <string>

#include "protocol/transport/clock.hpp"
#include "tests/support/pty.hpp"

namespace pitwall::transport {
namespace {

using support::Pty;

// The called end, on loopback.
class Listener {
 public:
  explicit Listener(std::uint16_t port = 0) {
    fd_ = FileDescriptor(posix_call([] { return socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0); }));
    const int on = 1;
    setsockopt(fd_.get(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(kLoopbackIp);
    auto* generic = reinterpret_cast<sockaddr*>(&address);
    EXPECT_EQ(::bind(fd_.get(), generic, sizeof address), 0);
    EXPECT_EQ(::listen(fd_.get(), 4), 0);
    socklen_t length = sizeof address;
    EXPECT_EQ(getsockname(fd_.get(), generic, &length), 0);
    port_ = ntohs(address.sin_port);
  }
  TcpAddress address() const { return {.port = port_}; }
  FileDescriptor accept() {
    return FileDescriptor(posix_call([&] { return ::accept(fd_.get(), nullptr, nullptr); }));
  }

 private:
  FileDescriptor fd_;
  std::uint16_t port_ = 0;
};

// A stream whose clock the test turns: real bytes need real time, patience does not.
struct Stream {
  StreamLink link;
  Instant now{seconds(100).ns};
  std::string received{};

  void read() {
    std::array<std::uint8_t, 64> buffer;
    const auto bytes = link.read(buffer, now);
    received.append(bytes.begin(), bytes.end());
  }
  template <class Until>
  bool read_until(Until&& until) {
    const Instant limit = monotonic_now() + seconds(10);
    while (!until() && monotonic_now() < limit) {
      read();
      sleep_until(monotonic_now() + microseconds(200));
    }
    return until();
  }
};

void say(const FileDescriptor& to, std::string_view text) {
  EXPECT_EQ(::send(to.get(), text.data(), text.size(), MSG_NOSIGNAL), std::ssize(text));
}

TEST(StreamLink, HearsWhatAConnectionSays) {
  Listener listener;
  Stream s{StreamLink{listener.address()}};
  ASSERT_TRUE(s.read_until([&] { return s.link.is_open(); }));
  const FileDescriptor other = listener.accept();
  say(other, "one two");
  EXPECT_TRUE(s.read_until([&] { return s.received == "one two"; })) << s.received;
  EXPECT_EQ(s.link.counters().bytes, 7U);
  EXPECT_EQ(s.link.counters().opened, 1U);
}

TEST(StreamLink, AConnectionThatEndsIsMadeAgainAfterAPause) {
  Listener listener;
  Stream s{StreamLink{listener.address()}};
  ASSERT_TRUE(s.read_until([&] { return s.link.is_open(); }));
  listener.accept().reset();
  ASSERT_TRUE(s.read_until([&] { return !s.link.is_open(); }));
  EXPECT_EQ(s.link.counters().ended, 1U);
  s.now += StreamLink::kPause - nanoseconds(1);
  for (int k = 0; k < 20; ++k) s.read();
  EXPECT_EQ(s.link.counters().opened, 1U) << "too soon";
  s.now += nanoseconds(1);
  ASSERT_TRUE(s.read_until([&] { return s.link.is_open(); }));
  say(listener.accept(), "again");
  EXPECT_TRUE(s.read_until([&] { return s.received == "again"; })) << s.received;
}

TEST(StreamLink, WhereNobodyListensEveryAttemptIsCounted) {
  TcpAddress nobody;
  {
    const Listener gone;
    nobody = gone.address();
  }
  Stream s{StreamLink{nobody}};
  for (std::uint64_t attempt = 1; attempt <= 3; ++attempt) {
    ASSERT_TRUE(s.read_until([&] { return s.link.counters().refused == attempt; }));
    s.now += StreamLink::kPause;
  }
  EXPECT_EQ(s.link.counters().opened, 0U);
  Listener late{nobody.port};
  EXPECT_TRUE(s.read_until([&] { return s.link.is_open(); })) << "it came up later";
}

TEST(StreamLink, AConnectionThatSaysNothingIsGivenUp) {
  Listener listener;
  Stream s{StreamLink{listener.address()}};
  ASSERT_TRUE(s.read_until([&] { return s.link.is_open(); }));
  const FileDescriptor other = listener.accept();
  s.now += StreamLink::kTimeout;
  s.read();
  EXPECT_TRUE(s.link.is_open());
  say(other, "here");
  ASSERT_TRUE(s.read_until([&] { return s.received == "here"; }));
  s.now += StreamLink::kTimeout;
  s.read();
  EXPECT_TRUE(s.link.is_open()) << "it spoke since";
  s.now += nanoseconds(1);
  s.read();
  EXPECT_FALSE(s.link.is_open());
  EXPECT_EQ(s.link.counters().silent, 1U);
}

// Every byte as it is: no echo, no newline is translated, no control character acts.
TEST(StreamLink, ASerialDeviceGivesEveryByteAsItIs) {
  const Pty pty;
  Stream s{StreamLink{SerialDevice{pty.path(), 460'800}}};
  s.read();
  ASSERT_TRUE(s.link.is_open());
  std::string every;
  for (int c = 0; c < 256; ++c) every += static_cast<char>(c);
  pty.say(every);
  EXPECT_TRUE(s.read_until([&] { return s.received.size() >= every.size(); }));
  EXPECT_EQ(s.received, every);
  s.now += StreamLink::kTimeout * 10;
  s.read();
  EXPECT_TRUE(s.link.is_open()) << "a silent device is not opened again: that would not wake it";
}

TEST(StreamLink, ASerialDeviceThatIsUnpluggedIsFoundAgain) {
  const std::filesystem::path name =
      std::filesystem::temp_directory_path() / ("pitwall_tty_" + std::to_string(getpid()));
  std::filesystem::remove(name);
  Stream s{StreamLink{SerialDevice{name.string(), 115'200}}};
  {
    const Pty first;
    std::filesystem::create_symlink(first.path(), name);
    ASSERT_TRUE(s.read_until([&] { return s.link.is_open(); }));
  }
  ASSERT_TRUE(s.read_until([&] { return !s.link.is_open(); }));
  EXPECT_EQ(s.link.counters().ended, 1U);
  std::filesystem::remove(name);
  s.now += StreamLink::kPause;
  s.read();
  EXPECT_EQ(s.link.counters().refused, 1U);
  const Pty second;
  std::filesystem::create_symlink(second.path(), name);
  s.now += StreamLink::kPause;
  s.read();
  EXPECT_TRUE(s.link.is_open());
  second.say("back");
  EXPECT_TRUE(s.read_until([&] { return s.received == "back"; })) << s.received;
  std::filesystem::remove(name);
}

}  // namespace
}  // namespace pitwall::transport
