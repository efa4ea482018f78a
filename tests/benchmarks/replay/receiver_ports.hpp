// UDP sockets that stand for the receivers' inputs of a car: every datagram with its bytes and the
// kernel's stamp.
//   in     datagrams to the ports of address(), from this machine; the offset that all stamps of
//          the run are converted with
//   out    what came, per receiver, oldest first
//   errors open(): Problem with a socket. lost(): what the queue of a socket did not hold
//   bound  drain() has to be called before a queue is full: at 165 datagrams a second a second
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
