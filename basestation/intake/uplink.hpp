// What the base station says to the car: one heartbeat each telemetry::kHeartbeatPeriod once a car
// was heard, the first at once. A car that fell silent is still told that its base lives: it may
// hear the base although the base does not hear it.
//   in     accepted packets of state, the time
//   out    poll(): the heartbeat that is due, empty before its time; due(): when that is
//   law    never two within a period; periods that were missed are not made up for
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "protocol/telemetry/heartbeat.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::intake {

struct UplinkCounters {
  std::uint64_t sent = 0, not_sent = 0;  // heartbeats; the socket refused the others
};

class Uplink {
 public:
  // `run`: another number after every start of the base (telemetry::run_number).
  explicit Uplink(std::uint32_t run) { next_.run = run; }

  void heard(const telemetry::StatePacket& packet, Instant received);
  // The bytes are valid until the next call.
  std::span<const std::uint8_t> poll(Instant now);
  std::optional<Instant> due() const { return due_; }

  // What became of the heartbeat of the last poll().
  void note(bool sent) { ++(sent ? counters_.sent : counters_.not_sent); }
  const UplinkCounters& counters() const { return counters_; }

 private:
  telemetry::BaseHeartbeat next_;
  Instant received_{};  // of the newest packet of state
  std::optional<Instant> due_;
  UplinkCounters counters_;
  telemetry::HeartbeatBuffer buffer_{};
};

}  // namespace pitwall::intake
