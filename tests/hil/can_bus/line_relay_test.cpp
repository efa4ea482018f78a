// SPDX-License-Identifier: Apache-2.0
#include "hil/can_bus/line_relay.hpp"

#include <gtest/gtest.h>

#include <string>

#include "protocol/transport/clock.hpp"
#include "protocol/transport/readiness.hpp"

namespace pitwall::can_bus {
namespace {

using transport::SerialLine;
using transport::UdpSocket;

std::uint16_t free_port() { return UdpSocket::bind({})->local().port; }

bool send(UdpSocket& from, std::uint16_t port, const std::string& text) {
  return from.send_to({.port = port},
                      {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

// Serves until a datagram is there; "nothing" after a few seconds.
template <class Serve>
transport::UdpDatagram receive(UdpSocket& at, Serve serve) {
  std::vector<transport::UdpDatagram> got(1);
  const Instant give_up = transport::monotonic_now() + seconds(5);
  while (transport::monotonic_now() < give_up) {
    serve();
    if (at.receive(got) == 1) return got[0];
  }
  ADD_FAILURE() << "nothing came";
  return got[0];
}

std::string text_of(const transport::UdpDatagram& d) {
  return {d.payload().begin(), d.payload().end()};
}

TEST(LineRelay, CarriesWholeDatagramsThroughTheLineBothWays) {
  auto base = UdpSocket::bind({});
  auto car = UdpSocket::bind({});
  auto ends = transport::stream_pair();
  ASSERT_TRUE(base && car && ends);
  auto host_line = SerialLine::adopt(std::move(ends->first));
  auto guest_line = SerialLine::adopt(std::move(ends->second));
  const std::uint16_t a = free_port(), c = free_port();
  auto host = LineRelay::open(a, base->local().port);
  auto guest = LineRelay::open(c, car->local().port);
  ASSERT_TRUE(host_line && guest_line && host && guest);
  const auto serve = [&] {
    host->serve(*host_line);
    guest->serve(*guest_line);
  };
  for (int i = 0; i < 50; ++i) {
    const std::string down(static_cast<std::size_t>(i * 28), 'd'), up(10, static_cast<char>(i));
    ASSERT_TRUE(send(*base, a, down));
    EXPECT_EQ(text_of(receive(*car, serve)), down);
    ASSERT_TRUE(send(*car, c, up));
    const auto got = receive(*base, serve);
    EXPECT_EQ(text_of(got), up);
    EXPECT_EQ(got.from.port, a);  // an answer to the sender finds its way back
  }
}

TEST(LineRelay, WithoutALineTheSamePortsWork) {
  auto base = UdpSocket::bind({});
  auto car = UdpSocket::bind({});
  ASSERT_TRUE(base && car);
  const LinePorts ports{free_port(), base->local().port, free_port(), car->local().port};
  auto relay = PortRelay::open(ports);
  ASSERT_TRUE(relay.has_value());
  const auto serve = [&] { relay->serve(); };
  ASSERT_TRUE(send(*base, ports.host_listen, "down"));
  const auto down = receive(*car, serve);
  EXPECT_EQ(text_of(down), "down");
  EXPECT_EQ(down.from.port, ports.guest_listen);
  ASSERT_TRUE(send(*car, ports.guest_listen, "up"));
  EXPECT_EQ(text_of(receive(*base, serve)), "up");
}

TEST(LineRelay, APortInUseIsNamed) {
  auto holder = UdpSocket::bind({});
  ASSERT_TRUE(holder.has_value());
  EXPECT_FALSE(LineRelay::open(holder->local().port, 1).has_value());
}

TEST(LinePorts, FourPortsOrAProblem) {
  const auto ports = parse_line_ports("1:22:333:65535");
  ASSERT_TRUE(ports.has_value());
  EXPECT_EQ(ports->host_listen, 1);
  EXPECT_EQ(ports->host_destination, 22);
  EXPECT_EQ(ports->guest_listen, 333);
  EXPECT_EQ(ports->guest_destination, 65535);
  for (const char* bad : {"", "1", "1:2:3", "1:2:3:", "1:2:3:4:5", "1:2:3:0", "1:2:3:65536",
                          "a:2:3:4", "1:2:3:4 ", "1::3:4", "-1:2:3:4"})
    EXPECT_FALSE(parse_line_ports(bad).has_value()) << bad;
}

}  // namespace
}  // namespace pitwall::can_bus
