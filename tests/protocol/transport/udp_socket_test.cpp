// SPDX-License-Identifier: Apache-2.0
#include "protocol/transport/udp_socket.hpp"

#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <array>
#include <string>
#include <vector>

#include "protocol/transport/clock.hpp"
#include "protocol/transport/readiness.hpp"
#include "protocol/vocabulary/bytes.hpp"
#include "tests/support/kernel_stamps.hpp"

namespace pitwall::transport {
namespace {

std::vector<UdpDatagram> collect(UdpSocket& socket, std::size_t count) {
  std::vector<UdpDatagram> all(count + 1);
  std::size_t n = 0;
  const Instant give_up = monotonic_now() + seconds(5);
  while (n < count && monotonic_now() < give_up) {
    const int watched[] = {socket.fd()};
    wait_readable(watched, give_up);
    n += socket.receive(std::span(all).subspan(n));
  }
  all.resize(n);
  return all;
}

TEST(UdpSocket, BindsToLoopbackAndTellsThePort) {
  const auto socket = UdpSocket::bind({});
  ASSERT_TRUE(socket.has_value());
  EXPECT_EQ(socket->local().ip, kLoopbackIp);
  EXPECT_NE(socket->local().port, 0);
  const auto taken = UdpSocket::bind(socket->local());
  ASSERT_FALSE(taken.has_value());
  EXPECT_EQ(taken.error().place, to_string(socket->local()));
}

TEST(UdpSocket, DatagramsArriveWholeInOrderWithSenderAndTime) {
  auto a = UdpSocket::bind({});
  auto b = UdpSocket::bind({});
  ASSERT_TRUE(a && b);
  const Instant before = monotonic_now();
  std::vector<std::string> sent;
  for (std::size_t i = 0; i < 100; ++i) {
    sent.push_back(std::string(i * 20, static_cast<char>(i)));
    ASSERT_TRUE(a->send_to(b->local(), as_bytes(sent.back())));
  }
  const auto received = collect(*b, sent.size());
  ASSERT_EQ(received.size(), sent.size());
  for (std::size_t i = 0; i < sent.size(); ++i) {
    const auto p = received[i].payload();
    EXPECT_EQ(std::string(p.begin(), p.end()), sent[i]);
    EXPECT_EQ(received[i].from, a->local());
    EXPECT_GE(received[i].at, before - milliseconds(50));
    EXPECT_LE(received[i].at, monotonic_now() + milliseconds(50));
  }
  EXPECT_EQ(b->counters().received, sent.size());
  EXPECT_EQ(a->counters().sent, sent.size());
}

TEST(UdpSocket, WithOneOffsetTheTimesOfTwoSocketsHaveTheOrderOfSending) {
  // GIVEN two sockets with an offset that is 3 ms too large: it is theirs, and no other is read
  const UdpSocket stamps = pitwall::testing::await_kernel_stamps();
  const Duration offset = realtime_minus_monotonic() + milliseconds(3);
  auto from = UdpSocket::bind({});
  auto even = UdpSocket::bind({}, {.clock_offset = offset});
  auto odd = UdpSocket::bind({}, {.clock_offset = offset});
  ASSERT_TRUE(from && even && odd);
  // WHEN datagrams go to them by turns, and each is read now and then
  std::vector<UdpDatagram> evens, odds;
  const auto take = [](UdpSocket& socket, std::vector<UdpDatagram>& into) {
    const auto some = collect(socket, 4);
    into.insert(into.end(), some.begin(), some.end());
  };
  const Instant before = monotonic_now();
  for (std::size_t i = 0; i < 400; ++i) {
    UdpSocket& to = i % 2 == 0 ? *even : *odd;
    ASSERT_TRUE(from->send_to(to.local(), as_bytes(std::string{"x"})));
    if (i % 8 == 7) take(*even, evens), take(*odd, odds);
  }
  const Instant after = monotonic_now();
  // THEN the order is kept, without a tolerance
  ASSERT_EQ(evens.size(), 200U);
  ASSERT_EQ(odds.size(), 200U);
  for (std::size_t i = 0; i < odds.size(); ++i) EXPECT_GE(odds[i].at, evens[i].at) << i;
  for (std::size_t i = 1; i < odds.size(); ++i) EXPECT_GE(evens[i].at, odds[i - 1].at) << i;
  EXPECT_LT(evens.front().at, before - milliseconds(2));
  EXPECT_LT(odds.back().at, after - milliseconds(2));
}

TEST(UdpSocket, TooLongIsCountedAndTheNextOnesCloseTheGap) {
  auto a = UdpSocket::bind({});
  auto b = UdpSocket::bind({});
  ASSERT_TRUE(a && b);
  ASSERT_TRUE(a->send_to(b->local(), as_bytes("first")));
  ASSERT_TRUE(a->send_to(b->local(), as_bytes(std::string(kMaxDatagramBytes + 1, 'x'))));
  ASSERT_TRUE(a->send_to(b->local(), as_bytes(std::string(kMaxDatagramBytes, 'y'))));
  const auto received = collect(*b, 2);
  ASSERT_EQ(received.size(), 2U);
  EXPECT_EQ(received[0].payload()[0], 'f');
  EXPECT_EQ(received[1].length, kMaxDatagramBytes);
  EXPECT_EQ(received[1].payload().back(), 'y');
  EXPECT_EQ(b->counters().rx_truncated, 1U);
}

TEST(UdpSocket, AConnectedSocketHearsOnlyItsPeer) {
  auto a = UdpSocket::bind({});
  auto b = UdpSocket::bind({});
  auto stranger = UdpSocket::bind({});
  ASSERT_TRUE(a && b && stranger);
  ASSERT_TRUE(b->connect(a->local()));
  ASSERT_TRUE(stranger->send_to(b->local(), as_bytes("intruder")));
  ASSERT_TRUE(a->send_to(b->local(), as_bytes("friend")));
  const auto received = collect(*b, 1);
  ASSERT_EQ(received.size(), 1U);
  EXPECT_EQ(received[0].length, 6U);
  ASSERT_TRUE(b->send(as_bytes("answer")));
  EXPECT_EQ(collect(*a, 1).size(), 1U);
}

TEST(UdpSocket, NobodyAtTheOtherEndIsCountedAndSendingGoesOn) {
  auto a = UdpSocket::bind({});
  auto gone = UdpSocket::bind({});
  ASSERT_TRUE(a && gone);
  const UdpAddress nobody = gone->local();
  gone = UdpSocket::bind({});
  ASSERT_TRUE(a->connect(nobody));
  for (int i = 0; i < 10; ++i) EXPECT_TRUE(a->send(as_bytes("hello")));
  std::vector<UdpDatagram> none(4);
  EXPECT_EQ(a->receive(none), 0U);
  EXPECT_GT(a->counters().rx_refused, 0U);
  EXPECT_EQ(a->counters().tx_failed, 0U);
}

// As the kernel has it: the code point is the upper six bits of the type of service (RFC 2474).
TEST(UdpSocket, MarksWhatItSends) {
  for (const std::uint8_t dscp : std::to_array<std::uint8_t>({0, 8, 46, 63})) {
    const auto socket = UdpSocket::bind({}, {.dscp = dscp});
    ASSERT_TRUE(socket);
    int service = -1;
    socklen_t length = sizeof service;
    ASSERT_EQ(getsockopt(socket->fd(), IPPROTO_IP, IP_TOS, &service, &length), 0);
    EXPECT_EQ(service, dscp << 2);
  }
}

TEST(UdpAddress, TextThereAndBack) {
  for (const char* text : {"127.0.0.1:5000", "0.0.0.0:0", "255.255.255.255:65535", "10.42.0.7:1"}) {
    const auto address = parse_udp_address(text);
    ASSERT_TRUE(address.has_value()) << text;
    EXPECT_EQ(to_string(*address), text);
  }
  EXPECT_EQ(*parse_udp_address("7300"), (UdpAddress{.ip = kLoopbackIp, .port = 7300}));
  for (const char* text : {"", ":", "127.0.0.1", "127.0.0.1:", "1.2.3:5", "localhost:5", "70000",
                           "-1", "5x", "1.2.3.4:5 "}) {
    const auto address = parse_udp_address(text);
    ASSERT_FALSE(address.has_value()) << text;
    EXPECT_EQ(address.error().place, text);
  }
}

}  // namespace
}  // namespace pitwall::transport
