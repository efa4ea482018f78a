// The other end is the car's own: StreamLink.
// SPDX-License-Identifier: Apache-2.0
#include "protocol/transport/stream/stream_sender.hpp"

#include <gtest/gtest.h>
#include <sys/socket.h>

#include <array>
#include <string>

#include "protocol/transport/clock.hpp"
#include "tests/support/pty.hpp"

namespace pitwall::transport {
namespace {

std::vector<std::uint8_t> record(std::uint8_t number, std::size_t size) {
  return std::vector<std::uint8_t>(size, number);
}

// Reads until so many bytes have come, or for 10 s; meanwhile the sender is served.
std::vector<std::uint8_t> read_from(StreamLink& link, StreamSender& sender, std::size_t bytes) {
  std::vector<std::uint8_t> all;
  std::array<std::uint8_t, 4'096> buffer;
  const Instant limit = monotonic_now() + seconds(10);
  while (all.size() < bytes && monotonic_now() < limit) {
    sender.service();
    const auto some = link.read(buffer, monotonic_now());
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

void connect(StreamLink& link, StreamSender& sender) {
  std::array<std::uint8_t, 1> nothing;
  const Instant limit = monotonic_now() + seconds(10);
  while (!(link.is_open() && sender.is_open()) && monotonic_now() < limit) {
    link.read(nothing, monotonic_now());
    sender.service();
  }
  ASSERT_TRUE(link.is_open() && sender.is_open());
}

TEST(StreamSender, ACallerGetsWhatIsSentWhileItIsThere) {
  auto sender = StreamSender::listen({});
  ASSERT_TRUE(sender) << to_string(sender.error());
  EXPECT_FALSE(sender->send(record(1, 10)));
  StreamLink car{sender->local()};
  connect(car, *sender);
  EXPECT_TRUE(sender->send(record(2, 3)));
  EXPECT_TRUE(sender->send(record(3, 2)));
  EXPECT_EQ(read_from(car, *sender, 5), (std::vector<std::uint8_t>{2, 2, 2, 3, 3}));
  EXPECT_EQ(sender->counters().dropped_absent, 1U);
  EXPECT_EQ(sender->counters().opened, 1U);
  EXPECT_EQ(sender->counters().sent_bytes, 5U);
}

// Fills the sender of somebody who does not read; the records that it took.
std::vector<std::uint8_t> fill(StreamSender& sender, std::size_t size) {
  std::vector<std::uint8_t> taken;
  std::uint8_t number = 0;
  while (sender.counters().dropped_full < 100) {
    if (sender.send(record(++number, size))) {
      const auto bytes = record(number, size);
      taken.insert(taken.end(), bytes.begin(), bytes.end());
    }
  }
  return taken;
}

TEST(StreamSender, WhoDoesNotReadGetsWholeRecordsOnlyAndTheOthersAreCounted) {
  auto sender = StreamSender::listen({});
  ASSERT_TRUE(sender);
  StreamLink car{sender->local()};
  connect(car, *sender);
  auto taken = fill(*sender, 1'000);
  EXPECT_GT(sender->queued_bytes(), StreamSender::kMaxQueued_bytes - 1'000);
  EXPECT_EQ(read_from(car, *sender, taken.size()), taken);
  EXPECT_EQ(sender->queued_bytes(), 0U);
  EXPECT_TRUE(sender->send(record(7, 4)));
  EXPECT_EQ(read_from(car, *sender, 4), record(7, 4));
  EXPECT_EQ(sender->counters().lost_bytes, 0U);
}

TEST(StreamSender, TheNextCallerBeginsWithAWholeRecord) {
  auto sender = StreamSender::listen({});
  ASSERT_TRUE(sender);
  {
    StreamLink first{sender->local()};
    connect(first, *sender);
    fill(*sender, 999);
  }
  const Instant limit = monotonic_now() + seconds(10);
  while (sender->is_open() && monotonic_now() < limit) sender->service();
  EXPECT_EQ(sender->counters().ended, 1U);
  EXPECT_GT(sender->counters().lost_bytes, StreamSender::kMaxQueued_bytes - 999);
  StreamLink second{sender->local()};
  connect(second, *sender);
  EXPECT_TRUE(sender->send(record(9, 5)));
  EXPECT_EQ(read_from(second, *sender, 5), record(9, 5));
}

TEST(StreamSender, CommandsOfTheCallerAreReadAndIgnored) {
  auto sender = StreamSender::listen({});
  ASSERT_TRUE(sender);
  auto caller = begin_connect(sender->local());
  ASSERT_TRUE(caller);
  const std::string command = "log bestposb ontime 0.05\r\n";
  const Instant limit = monotonic_now() + seconds(10);
  while (!connect_outcome(caller->get()) && monotonic_now() < limit) {
  }
  ASSERT_EQ(::send(caller->get(), command.data(), command.size(), 0), std::ssize(command));
  while (sender->counters().ignored_bytes < command.size() && monotonic_now() < limit)
    sender->service();
  EXPECT_EQ(sender->counters().ignored_bytes, command.size());
  EXPECT_TRUE(sender->is_open());
}

TEST(StreamSender, APortThatIsTakenIsNamed) {
  const auto first = StreamSender::listen({});
  ASSERT_TRUE(first);
  const auto second = StreamSender::listen(first->local());
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().place, to_string(first->local()));
}

TEST(StreamSender, ASerialLineCarriesTheBytesAsTheyAreAndNobodyWaitsForIt) {
  const support::Pty pty;
  auto sender = StreamSender::open({.path = pty.path(), .baud = 115'200});
  ASSERT_TRUE(sender) << to_string(sender.error());
  EXPECT_TRUE(sender->is_open());
  const auto taken = fill(*sender, 512);
  std::vector<std::uint8_t> all;
  const Instant limit = monotonic_now() + seconds(10);
  while (all.size() < taken.size() && monotonic_now() < limit) {
    std::array<std::uint8_t, 512> buffer;
    const std::size_t some = pty.read(buffer);
    all.insert(all.end(), buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(some));
    sender->service();
  }
  EXPECT_EQ(all, taken);
  EXPECT_GE(sender->counters().dropped_full, 100U);
  EXPECT_FALSE(StreamSender::open({.path = "/dev/no_such_tty", .baud = 9'600}));
}

}  // namespace
}  // namespace pitwall::transport
