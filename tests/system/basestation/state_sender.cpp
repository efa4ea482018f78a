// A car on loopback for the system test: state_sender ADDRESS COUNT. Sends COUNT packets with
// numbers 1..COUNT, each tenth left out, each seventh twice, and three damaged ones at the end.
// SPDX-License-Identifier: Apache-2.0
#include <string>

#include "protocol/telemetry/state_packet.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/udp_socket.hpp"

int main(int argc, char** argv) {
  using namespace pitwall;
  if (argc != 3) return 2;
  const auto base = transport::parse_udp_address(argv[1]);
  const auto count = static_cast<std::uint32_t>(std::stoul(argv[2]));
  auto socket = transport::UdpSocket::bind({});
  if (!socket || !base) return 1;

  telemetry::StatePacket packet;
  packet.run = 1;
  packet.source = telemetry::Source::kSimulation;
  packet.age_of(telemetry::Group::kEgo) = milliseconds(3);
  telemetry::PacketBuffer buffer;
  telemetry::EncodeCounters counters;
  transport::Ticker ticker{milliseconds(2)};
  for (packet.sequence = 1; packet.sequence <= count; ++packet.sequence) {
    ticker.next();
    if (packet.sequence % 10 == 0) continue;
    packet.sent = transport::monotonic_now();
    packet.values[telemetry::field("ego.vx")] = 0.5 * packet.sequence;
    const auto bytes = telemetry::encode(packet, buffer, counters);
    for (int i = 0; i < (packet.sequence % 7 == 0 ? 2 : 1); ++i) {
      if (!socket->send_to(*base, bytes)) return 1;
    }
  }
  buffer[50] ^= 1U;
  for (int i = 0; i < 3; ++i) {
    if (!socket->send_to(*base, buffer)) return 1;
  }
  return 0;
}
