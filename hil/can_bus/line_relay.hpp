// Relay of UDP datagrams between a local port and the serial line of a guest, or between two pairs
// of ports if there is no guest.
//
//   host                                   guest
//   :b <- send   LineRelay(a, b) == line == LineRelay(c, d)   send -> :d
//   :a -> listen                                              listen <- :c
//
//   in     datagrams on the listening port, datagrams on the line
//   out    the same datagrams on the other side, each complete or not at all
//   errors open(): Problem with the port; sockets and line count their losses
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "protocol/transport/stream/serial_line.hpp"
#include "protocol/transport/udp_socket.hpp"
#include "protocol/vocabulary/result.hpp"

namespace pitwall::can_bus {

struct LinePorts {
  std::uint16_t host_listen = 0;        // a
  std::uint16_t host_destination = 0;   // b
  std::uint16_t guest_listen = 0;       // c
  std::uint16_t guest_destination = 0;  // d
};

// "a:b:c:d", four ports from 1 to 65535.
Result<LinePorts, Problem> parse_line_ports(std::string_view text);

// One end of the line, in the guest or on the host.
class LineRelay {
 public:
  static Result<LineRelay, Problem> open(std::uint16_t listen, std::uint16_t destination);
  void serve(transport::SerialLine& line);  // forwards all waiting data both ways; never blocks
  int fd() const { return socket_.fd(); }
  const transport::UdpCounters& counters() const { return socket_.counters(); }

 private:
  LineRelay(transport::UdpSocket socket, std::uint16_t destination);

  transport::UdpSocket socket_;
  std::uint16_t destination_;
  std::vector<transport::UdpDatagram> datagrams_;
};

// Both ends in one process, without a line: a -> d (sent from c), c -> b (sent from a).
class PortRelay {
 public:
  static Result<PortRelay, Problem> open(const LinePorts& ports);
  void serve();
  int host_fd() const { return host_.fd(); }
  int guest_fd() const { return guest_.fd(); }

 private:
  PortRelay(transport::UdpSocket host, transport::UdpSocket guest, const LinePorts& ports);
  void carry(transport::UdpSocket& from, transport::UdpSocket& to, std::uint16_t destination);

  transport::UdpSocket host_, guest_;
  LinePorts ports_;
  std::vector<transport::UdpDatagram> datagrams_;
};

}  // namespace pitwall::can_bus
