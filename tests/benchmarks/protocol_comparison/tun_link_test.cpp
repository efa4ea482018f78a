// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/protocol_comparison/tun_link.hpp"

#include <gtest/gtest.h>

#include <array>
#include <optional>
#include <set>

#include "protocol/transport/clock.hpp"
#include "protocol/transport/readiness.hpp"
#include "protocol/transport/udp_socket.hpp"

namespace pitwall::benchmarks {
namespace {

constexpr std::uint32_t kCar = 0x0A4D0001, kBase = 0x0A4D0002;
constexpr std::uint16_t kPort = 5'000;
constexpr std::size_t kPayload = 100, kPacket = kPayload + 28;

class TunLinkTest : public ::testing::Test {
 protected:
  void SetUp() override {
    auto car = transport::TunNetwork::create({.address = kCar});
    auto base = transport::TunNetwork::create({.address = kBase});
    if (!car || !base) GTEST_SKIP() << to_string((car ? base : car).error());
    car_.emplace(*std::move(car));
    base_.emplace(*std::move(base));
  }
  static transport::UdpSocket socket_in(const transport::TunNetwork& network) {
    std::optional<transport::UdpSocket> made;
    const auto done = network.inside([&] {
      auto bound = transport::UdpSocket::bind({transport::kAnyIp, kPort});
      if (bound) made.emplace(*std::move(bound));
    });
    EXPECT_TRUE(done && made);
    return *std::move(made);
  }
  // The first bytes of all that comes until so many have come and then nothing for a while; the
  // machine may take its time with the first ones.
  static std::multiset<std::uint8_t> received(transport::UdpSocket& socket, std::size_t wanted) {
    std::multiset<std::uint8_t> first;
    std::vector<transport::UdpDatagram> batch(32);
    const std::array watched{socket.fd()};
    const auto patience = [&] { return first.size() < wanted ? seconds(10) : milliseconds(500); };
    while (transport::wait_readable(watched, transport::monotonic_now() + patience()) != 0)
      for (std::size_t i = 0, count = socket.receive(batch); i < count; ++i)
        first.insert(batch[i].data[0]);
    return first;
  }
  std::optional<transport::TunNetwork> car_, base_;
};

TEST_F(TunLinkTest, CarriesBothWaysAsTheEmulatorDecides) {
  link::LinkParams down, up;
  down.delay = milliseconds(5);
  down.duplicate = 1.0;
  up.loss = 1.0;
  TunLink radio(*car_, *base_, down, up, 1, transport::monotonic_now());
  transport::UdpSocket car = socket_in(*car_), base = socket_in(*base_);
  constexpr std::uint8_t kCount = 50;
  for (std::uint8_t i = 0; i < kCount; ++i) {
    const std::vector<std::uint8_t> bytes(kPayload, i);
    EXPECT_TRUE(car.send_to({kBase, kPort}, bytes));
    EXPECT_TRUE(base.send_to({kCar, kPort}, bytes));
  }
  const auto at_base = received(base, 2U * kCount);
  for (std::uint8_t i = 0; i < kCount; ++i) EXPECT_EQ(at_base.count(i), 2U);
  EXPECT_TRUE(received(car, 0).empty());

  const LinkTally& tally = radio.stop();
  EXPECT_EQ(tally.down.counters.duplicated, kCount);
  EXPECT_EQ(tally.up.counters.lost, kCount);
  EXPECT_EQ(tally.down.refused, 0U);
  ASSERT_EQ(tally.down.offered.size(), kCount);
  for (const OfferedPacket& packet : tally.down.offered) EXPECT_EQ(packet.bytes, kPacket);
  EXPECT_EQ(tally.down.counters.bytes, kCount * kPacket);  // the packet's own headers, once
}

TEST_F(TunLinkTest, NothingIsDeliveredBeforeTheEmulatorSays) {
  link::LinkParams slow;
  slow.rate_bytes_per_s = 12'800.0;  // 10 ms for each
  slow.delay = milliseconds(30);
  const Instant start = transport::monotonic_now();
  TunLink radio(*car_, *base_, slow, slow, 1, start);
  transport::UdpSocket car = socket_in(*car_), base = socket_in(*base_);
  constexpr int kCount = 20;
  const Instant sent = transport::monotonic_now();
  for (int i = 0; i < kCount; ++i)
    EXPECT_TRUE(car.send_to({kBase, kPort}, std::vector<std::uint8_t>(kPayload, 1)));
  std::vector<transport::UdpDatagram> batch(32);
  int came = 0;
  while (came < kCount) {
    const std::array watched{base.fd()};
    ASSERT_NE(transport::wait_readable(watched, transport::monotonic_now() + seconds(5)), 0U);
    for (std::size_t i = 0, count = base.receive(batch); i < count; ++i) {
      ++came;
      EXPECT_GE(batch[i].at - sent, milliseconds(30) + milliseconds(10) * came - microseconds(50));
    }
  }
  for (const Duration late : radio.stop().down.late) EXPECT_GE(late, Duration{});
}

}  // namespace
}  // namespace pitwall::benchmarks
