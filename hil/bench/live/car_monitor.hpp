// Monitor of the car's state for grading: receives the local report that the car sends to a port of
// this machine. The radio is encrypted and is not read.
//   in     datagrams at a socket on loopback
//   out    the car's latest report; counters
//   errors open(): Problem with the port; later counters only
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "hil/bench/signals.hpp"
#include "protocol/telemetry/state_packet.hpp"
#include "protocol/transport/udp_socket.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::bench {

class CarMonitor {
 public:
  // After this time without a report the car counts as silent.
  static constexpr Duration kSilence = milliseconds(300);

  // `port` 0: the kernel chooses.
  static Result<CarMonitor, Problem> open(std::uint16_t port);

  void read(Instant now);  // takes all waiting datagrams; never blocks

  // `silent` if reports came before and have stopped.
  const CarReport& report() const { return report_; }
  std::uint64_t packets() const { return packets_; }
  std::uint64_t refused() const { return refused_; }
  std::uint16_t port() const { return socket_.local().port; }

 private:
  explicit CarMonitor(transport::UdpSocket socket);
  void take(const telemetry::Values& values);

  transport::UdpSocket socket_;
  std::vector<transport::UdpDatagram> datagrams_;
  Instant received_at_{};
  CarReport report_;
  std::uint64_t packets_ = 0, refused_ = 0;
};

}  // namespace pitwall::bench
