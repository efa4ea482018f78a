// What needs no CAN in the kernel; playing is tested in tests/system/vcan.
// SPDX-License-Identifier: Apache-2.0
#include "hil/replay/socket_rim.hpp"

#include <gtest/gtest.h>

namespace pitwall::replay {
namespace {

TEST(SocketRim, AnInterfaceThatIsNotThereIsNamed) {
  Timeline timeline;
  timeline.tracks.push_back({.target = "nosuchcan0"});
  const auto rim = SocketRim::open(timeline);
  ASSERT_FALSE(rim.has_value());
  EXPECT_EQ(rim.error().place, "nosuchcan0");
}

TEST(SocketRim, TheLeadIsWhatSleepsAreLateHereWithinItsBound) {
  const Duration lead = SocketRim::measured_lead();
  EXPECT_GT(lead, Duration{});  // no sleep ends before its deadline
  EXPECT_LE(lead, kMaxLead);
}

// A rim without buses still waits: never shorter than to the look that is nearest to the deadline.
TEST(SocketRim, WaitsEndAtTheDeadlineWithAndWithoutALead) {
  auto rim = SocketRim::open(Timeline{});
  ASSERT_TRUE(rim.has_value()) << to_string(rim.error());
  for (const Duration lead : {Duration{}, microseconds(50), kMaxLead}) {
    rim->set_lead(lead);
    for (const Duration wait : {microseconds(30), microseconds(900), milliseconds(12)}) {
      const Instant deadline = rim->now() + wait;
      rim->wait_until(deadline);
      EXPECT_GE(rim->now(), deadline - kGroup / 2);
    }
  }
  EXPECT_FALSE(rim->stopped());
  EXPECT_EQ(rim->last_error(), "");
}

TEST(SocketRim, DatagramsOfOneCallComeInOrderWithTheirBytes) {
  auto port = transport::UdpSocket::bind({});
  ASSERT_TRUE(port);
  Timeline timeline;
  timeline.tracks.push_back({.target = "receiver",
                             .due = std::vector<Duration>(4),
                             .to = port->local(),
                             .datagrams = {.bytes = {1, 2, 3, 4, 5, 6, 7}, .ends = {1, 3, 6, 7}}});
  auto rim = SocketRim::open(timeline);
  ASSERT_TRUE(rim.has_value()) << to_string(rim.error());
  const TrackOutcome outcome = rim->send(0, 1, 3);
  EXPECT_EQ(outcome.taken, 3U);
  EXPECT_FALSE(outcome.full);
  std::vector<transport::UdpDatagram> got(8);
  ASSERT_EQ(port->receive(got), 3U);
  std::vector<std::vector<std::uint8_t>> bytes;
  for (std::size_t i = 0; i < 3; ++i)
    bytes.emplace_back(got[i].payload().begin(), got[i].payload().end());
  EXPECT_EQ(bytes, (std::vector<std::vector<std::uint8_t>>{{2, 3}, {4, 5, 6}, {7}}));
  EXPECT_EQ(rim->unheard(0), 0U);
}

TEST(SocketRim, AnAddressWithoutAWayIsNamed) {
  Timeline timeline;
  timeline.tracks.push_back(
      {.target = "255.255.255.255:9", .to = transport::UdpAddress{.ip = 0xFFFF'FFFF, .port = 9}});
  const auto rim = SocketRim::open(timeline);
  ASSERT_FALSE(rim.has_value());
  EXPECT_EQ(rim.error().place, "255.255.255.255:9");
}

}  // namespace
}  // namespace pitwall::replay
