// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/replay/receiver_ports.hpp"

namespace pitwall::benchmarks {

Result<ReceiverPorts, Problem> ReceiverPorts::open(Duration clock_offset) {
  std::vector<transport::UdpSocket> sockets;
  for (std::size_t receiver = 0; receiver < kReceivers; ++receiver) {
    auto socket = transport::UdpSocket::bind({}, {.clock_offset = clock_offset});
    if (!socket) return Unexpected{socket.error()};
    sockets.push_back(*std::move(socket));
  }
  return ReceiverPorts{std::move(sockets)};
}

std::string ReceiverPorts::address(std::size_t receiver) const {
  return to_string(sockets_[receiver].local());
}

void ReceiverPorts::drain() {
  for (std::size_t receiver = 0; receiver < kReceivers; ++receiver) {
    std::size_t taken = 0;
    while ((taken = sockets_[receiver].receive(batch_)) > 0) {
      for (std::size_t i = 0; i < taken; ++i) {
        const auto bytes = batch_[i].payload();
        received_[receiver].push_back({batch_[i].at, {bytes.begin(), bytes.end()}});
      }
    }
  }
}

std::uint64_t ReceiverPorts::lost() const {
  std::uint64_t lost = 0;
  for (const transport::UdpSocket& socket : sockets_)
    lost += socket.counters().rx_dropped_queue + socket.counters().rx_truncated +
            socket.counters().rx_failed;
  return lost;
}

}  // namespace pitwall::benchmarks
