// SPDX-License-Identifier: Apache-2.0
#include "protocol/transport/can/unix_bus.hpp"

#include <gtest/gtest.h>
#include <poll.h>

#include <random>

#include "tests/support/unix_bus_bench.hpp"

namespace pitwall::transport {
namespace {

using testing::RawClient;
using testing::UnixBusBench;

TEST(UnixBusAddress, APathIsTakenUpToTheKernelsOwnLimitAndRefusedBeyond) {
  for (std::size_t length = 0; length < 200; ++length) {
    const std::string name = "unix:" + std::string(length, 'p');
    const auto address = unix_bus_address(name);
    ASSERT_EQ(address.has_value(), length > 0 && length < sizeof(sockaddr_un::sun_path)) << length;
    if (address)
      EXPECT_EQ(address->sun_path, name.substr(5));
    else
      EXPECT_EQ(address.error().place, name);
  }
  for (const std::string& name : {std::string("vcan0"), std::string(), std::string("UNIX:/tmp/a"),
                                  std::string("unix:a\0b", 8)})
    EXPECT_FALSE(unix_bus_address(name)) << name;
}

TEST(LossNotice, SaysItsNumberAndLooksLikeAnOverrunToAnyReader) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 10'000; ++i) {
    const auto lost = static_cast<std::uint32_t>(random() >> (random() % 32));
    const can_frame notice = loss_notice(lost);
    CanWire wire{};
    std::memcpy(&wire, &notice, sizeof notice);
    ASSERT_EQ(read_loss_notice(wire, sizeof notice), lost);
    ASSERT_TRUE(is_carried(wire, sizeof notice));
    CanErrorCounters counted;
    decode_error(wire, BusState::kUnknown, counted);
    ASSERT_EQ(counted, CanErrorCounters{.controller = 1});
    wire.__res0 = 0;  // as the hub leaves it in what clients write
    ASSERT_EQ(read_loss_notice(wire, sizeof notice), std::nullopt);
  }
  EXPECT_EQ(read_loss_notice(CanWire{}, kCanFdWireBytes), std::nullopt);
}

TEST_F(UnixBusBench, AConnectionKnowsWhetherItsHubIsThere) {
  const auto address = unix_bus_address(bus_);
  ASSERT_TRUE(address);
  EXPECT_TRUE(hub_serves(*address));
  const RawClient receiver(bus_), send_only(bus_, ReceiveMode::kNothing);
  ASSERT_TRUE(receiver.connected() && send_only.connected());
  for (const bool served : {false, true}) {
    if (served) serve();
    EXPECT_TRUE(hub_is_there(receiver.fd()));
    EXPECT_TRUE(hub_is_there(send_only.fd()));
  }
  hub_.reset();
  EXPECT_FALSE(hub_is_there(receiver.fd()));
  EXPECT_FALSE(hub_is_there(send_only.fd()));
  EXPECT_FALSE(hub_is_there(-1));
  EXPECT_FALSE(hub_serves(*address));
}

TEST_F(UnixBusBench, AnEndKeepsItsDescriptorAndIsSilentWhileThereIsNoHub) {
  auto end = UnixBusEnd::open(bus_, {});
  ASSERT_TRUE(end) << to_string(end.error());
  const int descriptor = end->receiver();
  hub_.reset();
  pollfd watched{.fd = descriptor, .events = POLLIN, .revents = 0};
  EXPECT_EQ(poll(&watched, 1, 0), 1);  // its end can be read
  end->hang_up();
  EXPECT_FALSE(end->connected());
  EXPECT_EQ(poll(&watched, 1, 0), 0);  // once only: nobody who waits for frames spins
  EXPECT_FALSE(end->reconnect());
  start();
  EXPECT_TRUE(end->reconnect());
  EXPECT_EQ(end->receiver(), descriptor);
  RawClient other(bus_);
  ASSERT_TRUE(other.send(testing::numbered(1, 2)));
  serve();
  EXPECT_EQ(poll(&watched, 1, 0), 1);
}

TEST_F(UnixBusBench, WithoutAHubTheProblemSaysSoAndNamesThePlace) {
  hub_.reset();
  const auto end = UnixBusEnd::open(bus_, {});
  ASSERT_FALSE(end);
  EXPECT_EQ(end.error().place, bus_);
  EXPECT_NE(end.error().what.find("nobody serves"), std::string::npos);
  const auto long_name = UnixBusEnd::open("unix:/" + std::string(120, 'x'), {});
  ASSERT_FALSE(long_name);
  EXPECT_NE(long_name.error().what.find("found 121"), std::string::npos);
}

}  // namespace
}  // namespace pitwall::transport
