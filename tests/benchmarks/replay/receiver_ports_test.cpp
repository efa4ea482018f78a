// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/replay/receiver_ports.hpp"

#include <gtest/gtest.h>

#include <array>

#include "tests/support/kernel_stamps.hpp"

namespace pitwall::benchmarks {
namespace {

transport::UdpSocket sender_to(const ReceiverPorts& ports, std::size_t receiver) {
  auto socket = *transport::UdpSocket::bind({});
  EXPECT_TRUE(socket.connect(*transport::parse_udp_address(ports.address(receiver))));
  return socket;
}

TEST(ReceiverPorts, KeepWhatCameForEachReceiverInTheOrderInWhichItWasSent) {
  const transport::UdpSocket stamps = testing::await_kernel_stamps();
  auto ports = ReceiverPorts::open(transport::realtime_minus_monotonic());
  ASSERT_TRUE(ports) << to_string(ports.error());
  ASSERT_NE(ports->address(0), ports->address(1));
  auto first = sender_to(*ports, 0), second = sender_to(*ports, 1);
  for (std::uint8_t i = 0; i < 100; ++i) {
    ASSERT_TRUE(first.send(std::array<std::uint8_t, 2>{0, i}));
    if (i % 2 == 0) {
      ASSERT_TRUE(second.send(std::array<std::uint8_t, 2>{1, i}));
    }
    if (i % 10 == 9) ports->drain();
  }
  ports->drain();
  const ReceivedDatagrams& received = ports->received();
  ASSERT_EQ(received[0].size(), 100U);
  ASSERT_EQ(received[1].size(), 50U);
  EXPECT_EQ(received[0][99].bytes, (std::vector<std::uint8_t>{0, 99}));
  EXPECT_EQ(received[1][49].bytes, (std::vector<std::uint8_t>{1, 98}));
  // Across both receivers and all reads, without a tolerance.
  for (std::size_t i = 0; i < 50; ++i) {
    EXPECT_GE(received[1][i].at, received[0][2 * i].at);
    EXPECT_GE(received[0][2 * i + 1].at, received[1][i].at);
  }
  EXPECT_EQ(ports->lost(), 0U);
}

TEST(ReceiverPorts, WhatAFullQueueLosesIsCounted) {
  auto ports = ReceiverPorts::open({});
  ASSERT_TRUE(ports);
  auto sender = sender_to(*ports, 1);
  const std::array<std::uint8_t, 1'000> bytes{};
  for (int i = 0; i < 5'000; ++i) static_cast<void>(sender.send(bytes));
  ports->drain();
  ASSERT_TRUE(sender.send(bytes));  // the kernel tells with the next one
  ports->drain();
  EXPECT_GT(ports->lost(), 0U);
  EXPECT_EQ(ports->received()[1].size() + ports->lost(), 5'001U);
}

}  // namespace
}  // namespace pitwall::benchmarks
