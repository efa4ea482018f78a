// Two networks joined by hand: what one end sends is what we read, and what we write the other end
// receives. Needs root and /dev/net/tun.
// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/protocol_comparison/tun.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "protocol/transport/clock.hpp"
#include "protocol/transport/process.hpp"
#include "protocol/transport/readiness.hpp"
#include "protocol/transport/udp_socket.hpp"

namespace pitwall::transport {
namespace {

constexpr std::uint32_t kHere = 0x0A4D0001, kThere = 0x0A4D0002;  // 10.77.0.1, 10.77.0.2

class Tun : public ::testing::Test {
 protected:
  void SetUp() override {
    auto a = TunNetwork::create({.address = kHere});
    auto b = TunNetwork::create({.address = kThere});
    if (!a || !b) GTEST_SKIP() << "no network of its own: " << to_string((a ? b : a).error());
    here_.emplace(*std::move(a));
    there_.emplace(*std::move(b));
  }

  static UdpSocket socket_in(const TunNetwork& network, std::uint16_t port) {
    std::optional<UdpSocket> made;
    const auto done = network.inside([&] {
      auto bound = UdpSocket::bind({kAnyIp, port});
      if (bound) made.emplace(*std::move(bound));
    });
    EXPECT_TRUE(done && made);
    return *std::move(made);
  }

  std::optional<TunNetwork> here_, there_;
  std::array<std::uint8_t, 2'048> buffer_{};
};

// The next packet of the network with these ports; others (membership reports) are passed over.
std::optional<std::vector<std::uint8_t>> udp_packet_of(TunNetwork& network,
                                                       std::span<std::uint8_t> buffer) {
  const Instant deadline = monotonic_now() + seconds(5);
  while (monotonic_now() < deadline) {
    const std::array<int, 1> watched{network.fd()};
    wait_readable(watched, deadline);
    while (const auto packet = network.read(buffer))
      if ((*packet)[9] == 17) return std::vector<std::uint8_t>(packet->begin(), packet->end());
  }
  return std::nullopt;
}

TEST_F(Tun, CarriesADatagramFromOneNetworkToTheOther) {
  UdpSocket sender = socket_in(*here_, 4'000), receiver = socket_in(*there_, 5'000);
  const std::vector<std::uint8_t> text{'h', 'e', 'l', 'l', 'o'};
  ASSERT_TRUE(sender.send_to({kThere, 5'000}, text));
  const auto packet = udp_packet_of(*here_, buffer_);
  ASSERT_TRUE(packet);
  EXPECT_EQ(packet->size(), text.size() + 28);  // IPv4 and UDP
  ASSERT_TRUE(there_->write(*packet));

  const std::array<int, 1> watched{receiver.fd()};
  wait_readable(watched, monotonic_now() + seconds(5));
  std::vector<UdpDatagram> got(2);
  ASSERT_EQ(receiver.receive(got), 1U);
  EXPECT_EQ(got[0].from, (UdpAddress{kHere, 4'000}));
  EXPECT_TRUE(std::ranges::equal(got[0].payload(), text));
}

TEST_F(Tun, ALargeDatagramComesAsFragments) {
  UdpSocket sender = socket_in(*here_, 4'000);
  ASSERT_TRUE(sender.send_to({kThere, 5'000}, std::vector<std::uint8_t>(4'000, 1)));
  std::size_t bytes = 0, packets = 0;
  while (bytes < 4'000 + 8) {
    const auto packet = udp_packet_of(*here_, buffer_);
    ASSERT_TRUE(packet);
    ASSERT_LE(packet->size(), 1'500U);
    bytes += packet->size() - 20;
    ++packets;
  }
  EXPECT_EQ(bytes, 4'000U + 8U);
  EXPECT_EQ(packets, 3U);
}

TEST_F(Tun, MulticastGoesThroughTheInterfaceToo) {
  UdpSocket sender = socket_in(*here_, 4'000);
  ASSERT_TRUE(sender.send_to({0xEFFF4C43, 7'667}, std::vector<std::uint8_t>{1}));  // 239.255.76.67
  const auto packet = udp_packet_of(*here_, buffer_);
  ASSERT_TRUE(packet);
  EXPECT_EQ((*packet)[16], 239);
}

TEST_F(Tun, AProcessStartedInsideSeesOnlyThisNetwork) {
  std::optional<ExitStatus> ended;
  const auto done = here_->inside([&] {
    auto child =
        Process::spawn({.argv = {"sh", "-c",
                                 "test \"$(ls /proc/self/net/dev_snmp6 | sort | tr '\\n' ' ')\" = "
                                 "'lo radio0 '"}});
    if (child) ended = child->wait();
  });
  ASSERT_TRUE(done);
  ASSERT_TRUE(ended);
  EXPECT_TRUE(ended->success());
}

TEST_F(Tun, TheThreadIsBackHomeAfterwards) {
  const auto here = UdpSocket::bind({kHere, 0});
  EXPECT_FALSE(here);  // the address is of the other network
}

TEST(TunNetwork, SaysWhatTheKernelRefuses) {
  const auto made = TunNetwork::create({.name = "a/b", .address = kHere});
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().place, "network of its own");
  EXPECT_NE(made.error().what, "");
}

}  // namespace
}  // namespace pitwall::transport
