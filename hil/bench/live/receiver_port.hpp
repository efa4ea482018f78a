// UDP output of the bench's receivers: the byte stream of each unit, for the car and for every
// other listener with receivers of the same kind (the guardian).
//   in     samples of hil/sensors with `at` in scenario time; now, in scenario time too
//   out    datagrams to 127.0.0.1, two ports per listener: port for unit 0, port + 1 for unit 1
//   errors open(): Problem; the socket counts datagrams that the system did not accept
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
  // One port per listener, for unit 0; unit 1 uses the next port.
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
