// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/live/receiver_port.hpp"

namespace pitwall::bench {

Result<ReceiverPort, Problem> ReceiverPort::open(std::vector<std::uint16_t> first_ports,
                                                 ReceiverEncoder encoder) {
  auto socket = transport::UdpSocket::bind({});
  if (!socket) return Unexpected{socket.error()};
  return ReceiverPort{*std::move(socket), std::move(first_ports), std::move(encoder)};
}

void ReceiverPort::send(const world::SensorInput& samples, Instant now) {
  encoder_.encode(samples, now, [&](std::uint8_t unit, std::span<const std::uint8_t> bytes) {
    for (const std::uint16_t first : first_ports_)
      socket_.send_to({.ip = kLoopbackIp, .port = static_cast<std::uint16_t>(first + unit)}, bytes);
  });
}

}  // namespace pitwall::bench
