// State report to programs on the same machine (bench, tools): the plain snapshot without
// encryption, to a port of the loopback interface. It does not leave the machine and is independent
// of the radio.
//   in     the newest snapshot
//   out    one StatePacket per call; nothing without a port
//   errors open(): Problem with the port; afterwards the socket's counters
//   cost   no allocation after open()
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "protocol/telemetry/registry/registry.hpp"
#include "protocol/telemetry/state_packet.hpp"
#include "protocol/transport/udp_socket.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::io {

class LocalReport {
 public:
  // `port` 0: no report.
  static Result<LocalReport, Problem> open(std::uint16_t port, telemetry::Source source);

  void send(const telemetry::Snapshot& snapshot, Instant now);
  bool on() const { return socket_.has_value(); }

 private:
  LocalReport(std::optional<transport::UdpSocket> socket, std::uint16_t port,
              telemetry::Source source, std::uint32_t run)
      : socket_(std::move(socket)), port_(port), source_(source), run_(run) {}

  std::optional<transport::UdpSocket> socket_;
  std::uint16_t port_;
  telemetry::Source source_;
  std::uint32_t run_, sequence_ = 0;
  telemetry::EncodeCounters encoded_;
};

}  // namespace pitwall::io
