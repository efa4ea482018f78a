// Telemetry mapper: outputs of a tick to the fields of the telemetry registry.
//   in     Car and Outputs of this tick, what the log kept of earlier ones, Setup, and figures that
//          only the rim knows
//   out    telemetry::Snapshot of the groups of Direction::kDown, each with the time at which its
//          main signal was sampled
//   invariants
//          a field that the car does not know is NaN; a group never sampled has no time, and the
//          radio never sends it
//   unset  what no part of this car tells yet: suspension, tread, fuel, steering_unit and brakes
//          (the gateway does not decode those messages); opponents; torque, oil and traction of
//          powertrain; line, target_gap and cost of planner
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "protocol/telemetry/registry/snapshot.hpp"
#include "protocol/vocabulary/time.hpp"
#include "vehicle/pipeline/step.hpp"
#include "vehicle/pipeline/tick_log.hpp"
#include "vehicle/world/receiver_traffic.hpp"

namespace pitwall::pipeline {

// Known to the rim only: sockets, clocks, the radio. Unset: not known.
struct RimCounters {
  std::uint64_t frames_sent = 0, tx_drops = 0, steps = 0, missed_deadlines = 0;
  double step_time_max_us = kUnset;  // since the last snapshot
  double step_time_p50_us = kUnset;  // of the last hundred steps
  double processor_share = kUnset, memory_mib = kUnset, temperature_c = kUnset;
  // Of the radio: packets of the base that were accepted and that were not, sessions.
  std::uint64_t heartbeats = 0, heartbeats_refused = 0, base_runs = 0, slots_skipped = 0;
  double threats = kUnset;  // that the car sees: bits of telemetry::ThreatSet
  double round_trip_ms = kUnset;
  struct Path {
    double loss = kUnset, delay_p99_ms = kUnset;  // of what comes
    double budget_use = kUnset;                   // of what leaves
  };
  std::array<Path, 2> paths{};
  std::array<world::ReceiverTraffic, world::kGnssUnits> receivers{};
  // How samples for perception come; unset: none ever did.
  struct Stream {
    double rate_hz = kUnset, gap_ms = kUnset, latency_ms = kUnset;
  };
  Stream lidar{}, camera{}, radar{};
  // What the base said last, as the car's end of the radio keeps it; unset fields: nothing yet.
  struct Uplink {
    bool known = false;                                   // there is a radio
    double stop_latch = kUnset, stop_challenge = kUnset;  // of the latch
    double stop_reason = kUnset;                          // likewise
    double authority = kUnset;                            // who holds it; 0: nobody
    bool joystick = false;                                // its samples are live
    bool schema_agrees = false;
  } uplink{};
};

struct TapInputs {
  const Setup& setup;
  const Car& car;
  const Outputs& out;
  const TickLog& log;
  const RimCounters& rim;
  Instant now{};
};

telemetry::Snapshot tap(const TapInputs& in);

}  // namespace pitwall::pipeline
