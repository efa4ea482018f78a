// SPDX-License-Identifier: Apache-2.0
#include "hil/can_bus/line_relay.hpp"

#include <array>
#include <charconv>
#include <span>

namespace pitwall::can_bus {
namespace {

using transport::UdpSocket;

constexpr std::size_t kBatch = 32;

}  // namespace

Result<LinePorts, Problem> parse_line_ports(std::string_view text) {
  const auto refuse = [&] {
    return Unexpected{Problem{std::string(text),
                              "expected four ports HOST_LISTEN:HOST_DEST:GUEST_LISTEN:GUEST_DEST"}};
  };
  std::array<std::uint16_t, 4> ports{};
  const char* at = text.data();
  const char* const end = text.data() + text.size();
  for (std::size_t i = 0; i < ports.size(); ++i) {
    if (i > 0 && (at == end || *at++ != ':')) return refuse();
    const auto parsed = std::from_chars(at, end, ports[i]);
    if (parsed.ec != std::errc{} || ports[i] == 0) return refuse();
    at = parsed.ptr;
  }
  if (at != end) return refuse();
  return LinePorts{ports[0], ports[1], ports[2], ports[3]};
}

LineRelay::LineRelay(UdpSocket socket, std::uint16_t destination)
    : socket_(std::move(socket)), destination_(destination), datagrams_(kBatch) {}

Result<LineRelay, Problem> LineRelay::open(std::uint16_t listen, std::uint16_t destination) {
  auto socket = UdpSocket::bind({.port = listen});
  if (!socket) return Unexpected{socket.error()};
  return LineRelay(*std::move(socket), destination);
}

void LineRelay::serve(transport::SerialLine& line) {
  line.flush();
  while (const auto datagram = line.receive())
    static_cast<void>(socket_.send_to({.port = destination_}, *datagram));
  std::size_t count = 0;
  do {
    count = socket_.receive(datagrams_);
    for (const auto& d : std::span(datagrams_).first(count))
      static_cast<void>(line.send(d.payload()));
  } while (count == datagrams_.size());
}

PortRelay::PortRelay(UdpSocket host, UdpSocket guest, const LinePorts& ports)
    : host_(std::move(host)), guest_(std::move(guest)), ports_(ports), datagrams_(kBatch) {}

Result<PortRelay, Problem> PortRelay::open(const LinePorts& ports) {
  auto host = UdpSocket::bind({.port = ports.host_listen});
  if (!host) return Unexpected{host.error()};
  auto guest = UdpSocket::bind({.port = ports.guest_listen});
  if (!guest) return Unexpected{guest.error()};
  return PortRelay(*std::move(host), *std::move(guest), ports);
}

void PortRelay::serve() {
  carry(host_, guest_, ports_.guest_destination);
  carry(guest_, host_, ports_.host_destination);
}

void PortRelay::carry(UdpSocket& from, UdpSocket& to, std::uint16_t destination) {
  std::size_t count = 0;
  do {
    count = from.receive(datagrams_);
    for (const auto& d : std::span(datagrams_).first(count))
      static_cast<void>(to.send_to({.port = destination}, d.payload()));
  } while (count == datagrams_.size());
}

}  // namespace pitwall::can_bus
