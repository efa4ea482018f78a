// CanSocket against the kernel's own CAN. Runs where vcan0 exists (see CMakeLists.txt).
// SPDX-License-Identifier: Apache-2.0
#include "protocol/transport/can/can_socket.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <map>
#include <string>
#include <vector>

#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/transport/readiness.hpp"
#include "protocol/transport/udp_socket.hpp"
#include "tests/support/in_time.hpp"

namespace pitwall::transport {
namespace {

using pitwall::testing::in_time;

CanSocket open_vcan(const CanSocketOptions& options = {}) {
  auto socket = CanSocket::open("vcan0", options);
  EXPECT_TRUE(socket.has_value()) << (socket ? "" : to_string(socket.error()));
  return *std::move(socket);
}

can::Frame frame(std::uint32_t id, std::uint64_t payload, std::uint8_t length = 8) {
  can::Frame out;
  out.id = id;
  out.extended = id > can::kMaxStandardId;
  out.length = length;
  for (std::size_t i = 0; i < length && i < 8; ++i)
    out.data[i] = static_cast<std::uint8_t>(payload >> (8 * i));
  return out;
}

// Until `count` frames are there, or nothing has come for a second.
std::vector<can::ReceivedFrame> collect(CanSocket& socket, std::size_t count) {
  std::vector<can::ReceivedFrame> all(count + CanSocket::kBatch);
  std::size_t n = 0;
  while (n < count) {
    const int watched[] = {socket.fd()};
    if (wait_readable(watched, monotonic_now() + seconds(1)) == 0) break;
    n += socket.receive(std::span(all).subspan(n));
  }
  n += socket.receive(std::span(all).subspan(n));  // nothing more may come
  all.resize(n);
  return all;
}

TEST(CanSocket, EveryKindOfFrameArrivesAsItWasSent) {
  CanSocket sender = open_vcan();
  CanSocket reader = open_vcan();
  std::vector<can::Frame> sent;
  for (std::uint8_t length = 0; length <= 8; ++length) {
    sent.push_back(frame(0x100U + length, 0x1122334455667788U, length));
    sent.push_back(frame(0x18DA0000U + length, 0x99AABBCCDDEEFF00U, length));
  }
  can::Frame remote = frame(0x321, 0, 0);
  remote.remote = true;
  remote.length = 4;
  sent.push_back(remote);
  for (const unsigned length : {8U, 12U, 16U, 20U, 24U, 32U, 48U, 64U}) {
    can::Frame fd = frame(0x400U + length, 0x0807060504030201U, static_cast<std::uint8_t>(length));
    fd.fd = true;
    for (std::size_t i = 8; i < length; ++i) fd.data[i] = static_cast<std::uint8_t>(0xFF - i);
    sent.push_back(fd);
  }
  ASSERT_EQ(sender.send(sent), sent.size());
  const auto received = collect(reader, sent.size());
  ASSERT_EQ(received.size(), sent.size());
  for (std::size_t i = 0; i < sent.size(); ++i) EXPECT_EQ(received[i].frame, sent[i]) << i;
  EXPECT_EQ(reader.counters().received, sent.size());
  EXPECT_EQ(sender.counters().sent, sent.size());
}

TEST(CanSocket, OwnFramesComeBackOnlyWhereAsked) {
  CanSocket silent = open_vcan();
  CanSocket echo = open_vcan({.receive_own = true});
  ASSERT_TRUE(silent.send(frame(1, 1)));
  ASSERT_TRUE(echo.send(frame(2, 2)));
  const auto incoming = collect(silent, 1);
  ASSERT_EQ(incoming.size(), 1U);
  EXPECT_EQ(incoming[0].frame.id, 2U);
  EXPECT_EQ(collect(echo, 2).size(), 2U);
}

TEST(CanSocket, AFilterPassesExactlyItsKindAndId) {
  CanSocket sender = open_vcan();
  CanSocket standard = open_vcan({.filters = {{.id = 0x123}}});
  CanSocket range = open_vcan({.filters = {{.id = 0x120, .mask = 0x7F0}}});
  CanSocket extended = open_vcan({.filters = {{.id = 0x123, .extended = true}}});
  can::Frame alias = frame(0x123, 2);
  alias.extended = true;
  can::Frame far_alias = frame(0x18000123, 3);  // same low 11 bits: a plain 0x7FF mask lets it in
  can::Frame remote = frame(0x123, 0, 0);
  remote.remote = true;
  const std::vector<can::Frame> sent{frame(0x123, 1), alias,           far_alias,
                                     remote,          frame(0x124, 4), frame(0x133, 5)};
  ASSERT_EQ(sender.send(sent), sent.size());
  const auto only = collect(standard, 1);
  ASSERT_EQ(only.size(), 1U);
  EXPECT_EQ(only[0].frame, sent[0]);
  const auto two = collect(range, 2);
  ASSERT_EQ(two.size(), 2U);
  EXPECT_EQ(two[1].frame, sent[4]);
  const auto long_id = collect(extended, 1);
  ASSERT_EQ(long_id.size(), 1U);
  EXPECT_EQ(long_id[0].frame, alias);
}

TEST(CanSocket, ErrorFramesAreCountedByClassAndNeverData) {
  CanSocket sender = open_vcan();
  CanSocket reader = open_vcan();
  const std::uint8_t warning[] = {0, CAN_ERR_CRTL_TX_WARNING};
  const std::uint8_t passive[] = {0, CAN_ERR_CRTL_TX_PASSIVE};
  ASSERT_TRUE(sender.send_error(CAN_ERR_CRTL, warning));
  EXPECT_TRUE(collect(reader, 1).empty());
  EXPECT_EQ(reader.bus_state(), BusState::kWarning);
  ASSERT_TRUE(sender.send_error(CAN_ERR_CRTL, passive));
  ASSERT_TRUE(sender.send(frame(7, 7)));
  ASSERT_TRUE(sender.send_error(CAN_ERR_BUSOFF));
  ASSERT_EQ(collect(reader, 1).size(), 1U);  // the data frame between two error frames
  EXPECT_EQ(reader.bus_state(), BusState::kBusOff);
  ASSERT_TRUE(sender.send_error(CAN_ERR_RESTARTED));
  EXPECT_TRUE(collect(reader, 1).empty());
  EXPECT_EQ(reader.bus_state(), BusState::kActive);
  EXPECT_EQ(reader.counters().error_frames, 4U);
  EXPECT_EQ(reader.counters().errors.controller, 2U);
  EXPECT_EQ(reader.counters().errors.bus_off, 1U);
  EXPECT_EQ(reader.counters().errors.restarted, 1U);
}

TEST(CanSocket, StampsAreTheKernelsAndMonotonic) {
  CanSocket sender = open_vcan();
  CanSocket reader = open_vcan();
  const Instant before = monotonic_now();
  ASSERT_TRUE(sender.send(frame(1, 1)));
  const Instant after = monotonic_now();
  sleep_until(after + milliseconds(300));  // the reader comes late; the stamp must not
  const auto received = collect(reader, 1);
  ASSERT_EQ(received.size(), 1U);
  // Two clocks are read one after the other on a machine that may be busy: allow for that.
  const Duration tolerance = milliseconds(20);
  EXPECT_TRUE(in_time(before - received[0].at, tolerance));
  EXPECT_TRUE(in_time(received[0].at - after, tolerance));
  EXPECT_LT(received[0].at, after + milliseconds(290));  // not when it was read
}

// The guest's own calendar, which nobody else looks at.
void step_calendar(Duration by) {
  const std::int64_t to = utc_now().ns + by.ns;
  const timespec t{.tv_sec = to / kNanosecondsPerSecond, .tv_nsec = to % kNanosecondsPerSecond};
  ASSERT_EQ(clock_settime(CLOCK_REALTIME, &t), 0);
}

bool is_guest() {
  const auto processor = read_file("/proc/cpuinfo");
  return processor && processor->find("User Mode Linux") != std::string::npos;
}

TEST(CanSocket, ASteppedCalendarMovesNoStamp) {
  if (!is_guest()) GTEST_SKIP() << "would step the clock of this machine: only in the guest";
  CanSocket sender = open_vcan();
  CanSocket reader = open_vcan();
  auto hearer = UdpSocket::bind({.ip = kLoopbackIp, .port = 0});
  auto speaker = UdpSocket::bind({.ip = kLoopbackIp, .port = 0});
  ASSERT_TRUE(hearer && speaker);
  std::array<UdpDatagram, 4> datagrams;
  EXPECT_TRUE(collect(reader, 1).empty());
  EXPECT_EQ(hearer->receive(datagrams), 0U);
  for (const int step_s : {3600, -3600, 3600, -3600}) {
    for (const bool queued : {false, true}) {
      const Instant before = monotonic_now();
      if (!queued) step_calendar(seconds(step_s));
      ASSERT_TRUE(sender.send(frame(1, 1)));
      ASSERT_TRUE(speaker->send_to(hearer->local(), std::array<std::uint8_t, 1>{7}));
      if (queued) step_calendar(seconds(-step_s));
      const auto received = collect(reader, 1);
      const std::size_t count = hearer->receive(datagrams);
      const Instant after = monotonic_now();
      ASSERT_EQ(received.size(), 1U);
      ASSERT_EQ(count, 1U);
      for (const Instant at : {received[0].at, datagrams[0].at}) {
        EXPECT_TRUE(in_time(before - at, milliseconds(50))) << step_s << queued;
        EXPECT_TRUE(in_time(at - after, milliseconds(50))) << step_s << queued;
        EXPECT_GT(at, before - seconds(60)) << step_s << queued;
        EXPECT_LT(at, after + seconds(60)) << step_s << queued;
      }
    }
  }
}

TEST(CanSocket, ABurstOfTwentyThousandWaitsInTheBuffer) {
  CanSocket sender = open_vcan();
  CanSocket reader = open_vcan();
  ASSERT_EQ(reader.receive_buffer_bytes(), 8 << 20);
  std::vector<can::Frame> burst;
  for (std::uint32_t i = 0; i < 20'000; ++i) burst.push_back(frame(i % 0x700, i));
  ASSERT_EQ(sender.send(burst), burst.size());  // nobody reads meanwhile
  const auto received = collect(reader, burst.size());
  ASSERT_EQ(received.size(), burst.size());
  for (std::size_t i = 0; i < burst.size(); ++i) ASSERT_EQ(received[i].frame, burst[i]) << i;
  EXPECT_TRUE(std::is_sorted(received.begin(), received.end(),
                             [](const auto& a, const auto& b) { return a.at < b.at; }));
  reader.poll_drops();
  EXPECT_EQ(reader.counters().rx_dropped_queue, 0U);
}

TEST(CanSocket, LossIsCountedEvenWhenNothingFollowsIt) {
  CanSocket sender = open_vcan();
  CanSocket reader = open_vcan({.receive_buffer_bytes = 16'384});
  std::vector<can::Frame> burst(5'000, frame(5, 5));
  ASSERT_EQ(sender.send(burst), burst.size());
  const auto received = collect(reader, burst.size());
  ASSERT_LT(received.size(), burst.size());
  const std::size_t lost = burst.size() - received.size();
  reader.poll_drops();
  EXPECT_EQ(reader.counters().rx_dropped_queue, lost);
  EXPECT_EQ(reader.counters().rx_dropped_when_asked, lost);
  EXPECT_EQ(reader.counters().rx_dropped_by_frames, 0U);  // no frame came after the loss
  // And the other detector by itself: the next frame tells, though nobody asked again.
  ASSERT_TRUE(sender.send(frame(6, 6)));
  ASSERT_EQ(collect(reader, 1).size(), 1U);
  EXPECT_EQ(reader.counters().rx_dropped_by_frames, lost);
  EXPECT_EQ(reader.counters().rx_dropped_queue, lost);
}

TEST(CanSocket, AnImpossibleFrameIsRefusedAndTheRestGoesOut) {
  CanSocket sender = open_vcan();
  CanSocket reader = open_vcan();
  can::Frame impossible = frame(1, 1);
  impossible.length = 9;
  const std::vector<can::Frame> sent{impossible, frame(2, 2), impossible, frame(3, 3)};
  EXPECT_EQ(sender.send(sent), sent.size());
  EXPECT_EQ(sender.counters().tx_refused, 2U);
  EXPECT_EQ(collect(reader, 2).size(), 2U);
}

TEST(CanSocket, AMissingInterfaceIsNamed) {
  const auto socket = CanSocket::open("nosuchcan0");
  ASSERT_FALSE(socket.has_value());
  EXPECT_EQ(socket.error().place, "nosuchcan0");
}

}  // namespace
}  // namespace pitwall::transport
