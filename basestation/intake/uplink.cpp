// SPDX-License-Identifier: Apache-2.0
#include "basestation/intake/uplink.hpp"

namespace pitwall::intake {

using telemetry::kHeartbeatPeriod;

void Uplink::heard(const telemetry::StatePacket& packet, Instant received) {
  next_.heard_run = packet.run;
  next_.heard_sequence = packet.sequence;
  next_.heard_sent = packet.sent;
  received_ = received;
  if (!due_) due_ = received;
}

std::span<const std::uint8_t> Uplink::poll(Instant now) {
  if (!due_ || now < *due_) return {};
  const bool missed = now - *due_ >= kHeartbeatPeriod;
  due_ = (missed ? now : *due_) + kHeartbeatPeriod;
  next_.sent = now;
  next_.held = now - received_;
  const auto bytes = telemetry::encode(next_, buffer_);
  ++next_.sequence;
  return bytes;
}

}  // namespace pitwall::intake
