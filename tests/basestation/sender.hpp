// A car for tests: packets with rising numbers and recognisable values.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "protocol/telemetry/state_packet.hpp"

namespace pitwall {

struct Sender {
  telemetry::StatePacket packet = [] {
    telemetry::StatePacket p;
    p.run = 1;
    p.sequence = 100;
    p.source = telemetry::Source::kCar;
    return p;
  }();

  std::vector<std::uint8_t> bytes(std::uint32_t sequence) {
    packet.sequence = sequence;
    telemetry::PacketBuffer buffer;
    telemetry::EncodeCounters counters;
    const auto encoded = telemetry::encode(packet, buffer, counters);
    return {encoded.begin(), encoded.end()};
  }
};

}  // namespace pitwall
