// What needs no CAN in the kernel; playing is tested in tests/system/vcan.
// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/socket_io.hpp"

#include <gtest/gtest.h>

#include "protocol/transport/stream/tcp_connection.hpp"

namespace pitwall::replay {
namespace {

TEST(SocketIo, AnInterfaceThatIsNotThereIsNamed) {
  Timeline timeline;
  timeline.tracks.push_back({.target = "nosuchcan0"});
  const auto io = SocketIo::open(timeline);
  ASSERT_FALSE(io.has_value());
  EXPECT_EQ(io.error().place, "nosuchcan0");
}

TEST(SocketIo, TheLeadIsWhatSleepsAreLateHereWithinItsBound) {
  const Duration lead = SocketIo::measured_lead();
  EXPECT_GT(lead, Duration{});  // no sleep ends before its deadline
  EXPECT_LE(lead, kMaxLead);
}

// I/O without buses still waits: never shorter than to the look that is nearest to the deadline.
TEST(SocketIo, WaitsEndAtTheDeadlineWithAndWithoutALead) {
  auto io = SocketIo::open(Timeline{});
  ASSERT_TRUE(io.has_value()) << to_string(io.error());
  for (const Duration lead : {Duration{}, microseconds(50), kMaxLead}) {
    io->set_lead(lead);
    for (const Duration wait : {microseconds(30), microseconds(900), milliseconds(12)}) {
      const Instant deadline = io->now() + wait;
      io->wait_until(deadline);
      EXPECT_GE(io->now(), deadline - kGroup / 2);
    }
  }
  EXPECT_FALSE(io->stopped());
  EXPECT_EQ(io->last_error(), "");
}

TEST(SocketIo, DatagramsOfOneCallComeInOrderWithTheirBytes) {
  auto port = transport::UdpSocket::bind({});
  ASSERT_TRUE(port);
  Timeline timeline;
  timeline.tracks.push_back({.target = "receiver",
                             .due = std::vector<Duration>(4),
                             .to = port->local(),
                             .datagrams = {.bytes = {1, 2, 3, 4, 5, 6, 7}, .ends = {1, 3, 6, 7}}});
  auto io = SocketIo::open(timeline);
  ASSERT_TRUE(io.has_value()) << to_string(io.error());
  const TrackOutcome outcome = io->send(0, 1, 3);
  EXPECT_EQ(outcome.taken, 3U);
  EXPECT_FALSE(outcome.full);
  std::vector<transport::UdpDatagram> got(8);
  ASSERT_EQ(port->receive(got), 3U);
  std::vector<std::vector<std::uint8_t>> bytes;
  for (std::size_t i = 0; i < 3; ++i)
    bytes.emplace_back(got[i].payload().begin(), got[i].payload().end());
  EXPECT_EQ(bytes, (std::vector<std::vector<std::uint8_t>>{{2, 3}, {4, 5, 6}, {7}}));
  EXPECT_EQ(io->undelivered(0), 0U);
}

// A caller that connects and never reads.
transport::FileDescriptor deaf_caller(SocketIo& io, transport::TcpAddress to) {
  auto caller = transport::begin_connect(to);
  EXPECT_TRUE(caller);
  io.wait_for_clients(seconds(10));
  return caller ? *std::move(caller) : transport::FileDescriptor{};
}

std::uint16_t free_port() {
  const auto sender = transport::StreamSender::listen({});
  EXPECT_TRUE(sender);
  return sender ? sender->local().port : std::uint16_t{0};
}

// Records of 2 kB each 100 us to a TCP port, and at the same times datagrams of one byte to `udp`.
Timeline stream_and_datagrams(std::uint16_t tcp, UdpAddress udp, std::size_t records) {
  Timeline timeline;
  timeline.tracks.push_back({.target = "tcp", .to = TcpPort{{.port = tcp}}});
  timeline.tracks.push_back({.target = "udp", .to = udp});
  for (std::size_t i = 0; i < records; ++i) {
    for (Track& track : timeline.tracks) {
      const std::size_t size = track.target == "tcp" ? 2'000 : 1;
      track.due.push_back(microseconds(100 * static_cast<std::int64_t>(i)));
      track.datagrams.bytes.resize(track.datagrams.bytes.size() + size,
                                   static_cast<std::uint8_t>(i));
      track.datagrams.ends.push_back(track.datagrams.bytes.size());
    }
  }
  timeline.datagrams = 2 * records;
  timeline.pass = microseconds(100 * static_cast<std::int64_t>(records));
  return timeline;
}

TEST(SocketIo, WhoDoesNotReadAStreamHoldsNobodyUpAndIsCounted) {
  constexpr std::size_t kRecords = 300;
  auto port = transport::UdpSocket::bind({});
  ASSERT_TRUE(port);
  const std::uint16_t tcp = free_port();
  const Timeline timeline = stream_and_datagrams(tcp, port->local(), kRecords);
  auto io = SocketIo::open(timeline);
  ASSERT_TRUE(io.has_value()) << to_string(io.error());
  const auto caller = deaf_caller(*io, {.port = tcp});
  Player player(timeline, {}, *io);
  const PlayReport report = player.play(io->now());
  io->finish(milliseconds(1));
  EXPECT_EQ(report.retries, 0U);  // no wait for a queue
  const transport::StreamSenderCounters counters = io->streams().at(0).counters;
  EXPECT_GT(counters.dropped_full, 0U);
  EXPECT_EQ(report.datagrams.dropped_refused, counters.dropped_full);
  EXPECT_EQ(report.datagrams.sent + report.datagrams.dropped(), 2 * kRecords);
  EXPECT_EQ(counters.sent_bytes + counters.lost_bytes, 2'000 * (kRecords - counters.dropped_full));
  std::size_t got = 0;
  std::vector<transport::UdpDatagram> some(64);
  while (const std::size_t n = port->receive(some)) got += n;
  EXPECT_EQ(got, kRecords);
}

TEST(SocketIo, WithoutACallerTheRecordsOfAStreamAreDroppedAndCounted) {
  auto port = transport::UdpSocket::bind({});
  ASSERT_TRUE(port);
  const Timeline timeline = stream_and_datagrams(free_port(), port->local(), 20);
  auto io = SocketIo::open(timeline);
  ASSERT_TRUE(io.has_value());
  io->wait_for_clients(milliseconds(1));
  Player player(timeline, {}, *io);
  const PlayReport report = player.play(io->now());
  EXPECT_EQ(report.datagrams.sent, 20U);
  EXPECT_EQ(report.datagrams.dropped_refused, 20U);
  EXPECT_EQ(io->streams().at(0).counters.dropped_absent, 20U);
}

TEST(SocketIo, AnAddressWithoutAWayIsNamed) {
  Timeline timeline;
  timeline.tracks.push_back(
      {.target = "255.255.255.255:9", .to = UdpAddress{.ip = 0xFFFF'FFFF, .port = 9}});
  const auto io = SocketIo::open(timeline);
  ASSERT_FALSE(io.has_value());
  EXPECT_EQ(io.error().place, "255.255.255.255:9");
}

}  // namespace
}  // namespace pitwall::replay
