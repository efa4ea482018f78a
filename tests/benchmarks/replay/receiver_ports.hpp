// UDP sockets in place of a car's receiver inputs: they keep the bytes of every datagram and the
// kernel's stamp.
//   in     datagrams to the ports of address(), from this machine; the offset that converts all
//          stamps of the run
//   out    the received datagrams, per receiver, oldest first
//   errors open(): Problem with a socket. lost(): datagrams that a socket dropped, cut or failed to
//          receive
//   bound  drain() must be called before a queue is full: within a second at 165 datagrams a second
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "protocol/transport/udp_socket.hpp"
#include "protocol/vocabulary/result.hpp"
#include "tests/benchmarks/replay/sensor_arrival.hpp"

namespace pitwall::benchmarks {

class ReceiverPorts {
 public:
  static Result<ReceiverPorts, Problem> open(Duration clock_offset);

  std::string address(std::size_t receiver) const;
  void drain();
  const ReceivedDatagrams& received() const { return received_; }
  std::uint64_t lost() const;

 private:
  explicit ReceiverPorts(std::vector<transport::UdpSocket> sockets)
      : sockets_(std::move(sockets)), batch_(transport::UdpSocket::kBatch) {}

  std::vector<transport::UdpSocket> sockets_;
  std::vector<transport::UdpDatagram> batch_;
  ReceivedDatagrams received_;
};

}  // namespace pitwall::benchmarks
