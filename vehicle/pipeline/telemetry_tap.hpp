// What of a tick goes to the pit wall: pipeline outputs to the fields of the telemetry registry.
//   in     Outputs of this tick, Setup, counters that only the rim knows
//   out    telemetry::StatePacket without sequence, run and time of sending
//   law    a field that the car does not know is NaN; a group never sampled has a negative age
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "protocol/telemetry/state_packet.hpp"
#include "protocol/vocabulary/time.hpp"
#include "vehicle/pipeline/step.hpp"

namespace pitwall::pipeline {

// Known to main.cpp only: sockets and clocks.
struct RimCounters {
  std::uint64_t frames_sent = 0, tx_drops = 0, steps = 0, missed_deadlines = 0;
  double step_time_max_us = kUnset;  // since the last packet
  std::uint64_t heartbeats = 0, heartbeats_refused = 0, base_runs = 0;
  double round_trip_ms = kUnset;
};

telemetry::StatePacket tap(const Setup& setup, const Outputs& out, const RimCounters& rim,
                           Instant now);

}  // namespace pitwall::pipeline
