// UDP output of the bench's receivers: the bytes of each, one UDP port each, for the car and for
// whoever else has receivers of the same kind (the guardian).
//   in     samples of hil/sensors, `at` in scenario time; now, likewise
//   out    datagrams to 127.0.0.1:port and port + 1 of every listener
//   errors open(): Problem; a datagram that was not taken is counted by the socket
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "hil/bench/receiver_codec.hpp"
#include "protocol/transport/udp_socket.hpp"
#include "protocol/vocabulary/result.hpp"
#include "vehicle/world/sensor_input.hpp"

namespace pitwall::bench {

class ReceiverPort {
 public:
  // One port per listener: where unit 0 of that listener is heard.
  static Result<ReceiverPort, Problem> open(std::vector<std::uint16_t> first_ports,
                                            ReceiverEncoder encoder);

  void send(const world::SensorInput& samples, Instant now);
  const transport::UdpCounters& counters() const { return socket_.counters(); }

 private:
  ReceiverPort(transport::UdpSocket socket, std::vector<std::uint16_t> first_ports,
               ReceiverEncoder encoder)
      : socket_(std::move(socket)),
        first_ports_(std::move(first_ports)),
        encoder_(std::move(encoder)) {}

  transport::UdpSocket socket_;
  std::vector<std::uint16_t> first_ports_;
  ReceiverEncoder encoder_;
};

}  // namespace pitwall::bench
