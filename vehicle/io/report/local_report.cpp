// SPDX-License-Identifier: Apache-2.0
#include "vehicle/io/report/local_report.hpp"

#include "protocol/transport/clock.hpp"

namespace pitwall::io {
namespace {

// Rises by one every 17 ms, so that two starts never share a number.
std::uint32_t run_number() {
  return static_cast<std::uint32_t>(static_cast<std::uint64_t>(transport::utc_now().ns) >> 24U);
}

}  // namespace

Result<LocalReport, Problem> LocalReport::open(std::uint16_t port, telemetry::Source source) {
  if (port == 0) return LocalReport{std::nullopt, port, source, 0};
  auto socket = transport::UdpSocket::bind({.ip = kLoopbackIp, .port = 0});
  if (!socket) return Unexpected{socket.error()};
  return LocalReport{*std::move(socket), port, source, run_number()};
}

void LocalReport::send(const telemetry::Snapshot& snapshot, Instant now) {
  if (!socket_) return;
  telemetry::StatePacket packet = telemetry::packet_of(snapshot, now);
  packet.source = source_;
  packet.run = run_;
  packet.sequence = sequence_++;
  packet.sent = now;
  telemetry::PacketBuffer buffer;
  socket_->send_to({.ip = kLoopbackIp, .port = port_}, telemetry::encode(packet, buffer, encoded_));
}

}  // namespace pitwall::io
