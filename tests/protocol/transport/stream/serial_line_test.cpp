// SPDX-License-Identifier: Apache-2.0
#include "protocol/transport/stream/serial_line.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/transport/readiness.hpp"
#include "protocol/vocabulary/bytes.hpp"

namespace pitwall::transport {
namespace {

std::string receive(SerialLine& line) {
  for (int i = 0; i < 500; ++i) {
    if (const auto d = line.receive()) return {d->begin(), d->end()};
    const int watched[] = {line.fd()};
    wait_readable(watched, monotonic_now() + milliseconds(10));
  }
  return "nothing came";
}

struct Pair {
  SerialLine a, b;
};

Pair connected() {
  auto ends = stream_pair();
  auto a = SerialLine::adopt(std::move(ends->first));
  auto b = SerialLine::adopt(std::move(ends->second));
  return {*std::move(a), *std::move(b)};
}

TEST(SerialLine, DatagramsGoBothWays) {
  auto [a, b] = connected();
  for (const std::size_t n : {0UL, 1UL, 150UL, kMaxLineDatagramBytes}) {
    const std::string text(n, static_cast<char>(n % 251));
    ASSERT_TRUE(a.send(as_bytes(text)));
    EXPECT_EQ(receive(b), text);
    ASSERT_TRUE(b.send(as_bytes(text)));
    EXPECT_EQ(receive(a), text);
  }
  EXPECT_FALSE(a.send(as_bytes(std::string(kMaxLineDatagramBytes + 1, 'x'))));
  EXPECT_EQ(a.counters().tx_refused, 1U);
}

TEST(SerialLine, ASlowReaderCostsWholeDatagramsAndTheyAreCounted) {
  auto [a, b] = connected();
  std::uint64_t accepted = 0;
  const std::string text(1'000, 'x');
  for (int i = 0; i < 2'000; ++i) accepted += a.send(as_bytes(text)) ? 1U : 0U;
  ASSERT_LT(accepted, 2'000U);
  EXPECT_EQ(a.counters().tx_overflow, 2'000U - accepted);
  std::uint64_t received = 0;
  for (int i = 0; i < 10'000 && received < accepted; ++i) {
    a.flush();
    while (const auto d = b.receive()) {
      ASSERT_EQ(d->size(), text.size());
      ++received;
    }
  }
  EXPECT_EQ(received, accepted);
  EXPECT_FALSE(a.has_unsent());
  EXPECT_EQ(b.counters().received.bad_crc, 0U);
}

TEST(SerialLine, TheOtherEndGoneIsNoticedNotFatal) {
  auto ends = stream_pair();
  auto a = SerialLine::adopt(std::move(ends->first));
  ASSERT_TRUE(a.has_value());
  ends->second.reset();
  for (int i = 0; i < 3; ++i) static_cast<void>(a->send(as_bytes("into the void")));  // no SIGPIPE
  EXPECT_FALSE(a->receive().has_value());
  EXPECT_TRUE(a->closed());
}

TEST(SerialLine, ATtyIsRawInBothDirections) {
  FileDescriptor master(posix_call([] { return posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC); }));
  ASSERT_TRUE(master.valid());
  ASSERT_EQ(grantpt(master.get()), 0);
  ASSERT_EQ(unlockpt(master.get()), 0);
  auto tty = SerialLine::open(ptsname(master.get()));
  ASSERT_TRUE(tty.has_value()) << to_string(tty.error());
  ASSERT_TRUE(write_to(master.get(), "console noise\r\n"));
  auto other = SerialLine::adopt(std::move(master));
  ASSERT_TRUE(other.has_value());
  std::string every_byte;  // flow control, line ends and interrupts of a tty among them
  for (int i = 0; i < 256; ++i) every_byte += static_cast<char>(i);
  ASSERT_TRUE(other->send(as_bytes(every_byte)));
  EXPECT_EQ(receive(*tty), every_byte);
  ASSERT_TRUE(tty->send(as_bytes(every_byte)));
  EXPECT_EQ(receive(*other), every_byte);
}

TEST(SerialLine, AMissingTtyIsNamed) {
  const auto line = SerialLine::open("/dev/no-such-line");
  ASSERT_FALSE(line.has_value());
  EXPECT_EQ(line.error().place, "/dev/no-such-line");
}

}  // namespace
}  // namespace pitwall::transport
