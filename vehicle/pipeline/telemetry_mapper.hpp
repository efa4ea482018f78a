// Telemetry mapper: outputs of a tick to the fields of the telemetry registry.
//   in     Car and Outputs of this tick, the log of earlier ticks, Setup, and figures of the I/O
//   out    telemetry::Snapshot of the groups of Direction::kDown, each with the time at which its
//          main signal was sampled
//   invariants
//          a field with an unknown value is NaN; a group that was never sampled has no time, and
//          the radio never sends it
//   unset  fields that no part of this car provides yet: suspension, tread, steering_unit and
//          brakes (the gateway does not decode those messages); of fuel all but the laps left;
//          torque, oil and traction of powertrain; cost of planner
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "protocol/telemetry/registry/registry.hpp"
#include "protocol/vocabulary/time.hpp"
#include "vehicle/pipeline/step.hpp"
#include "vehicle/pipeline/tick_log.hpp"
#include "vehicle/world/receiver.hpp"

namespace pitwall::pipeline {

// Figures of the I/O: sockets, clocks, the radio. Unset if not known.
struct IoCounters {
  std::uint64_t frames_sent = 0, tx_drops = 0, steps = 0, missed_deadlines = 0;
  double step_time_max_us = kUnset;  // since the last snapshot
  double step_time_p50_us = kUnset;  // of the last hundred steps
  double processor_share = kUnset, memory_mib = kUnset, temperature_c = kUnset;
  // Radio: accepted and refused packets of the base, sessions.
  std::uint64_t heartbeats = 0, heartbeats_refused = 0, base_runs = 0, slots_skipped = 0;
  double threats = kUnset;  // detected by the car: bits of telemetry::ThreatSet
  double round_trip_ms = kUnset;
  struct Path {
    double loss = kUnset, delay_p99_ms = kUnset;  // receive direction
    double budget_use = kUnset;                   // transmit direction
  };
  std::array<Path, 2> paths{};
  std::array<world::ReceiverTraffic, world::kGnssUnits> receivers{};
  // Of a sensor that sees other cars; unset: the car has none, or it has not sent yet.
  struct Sensor {
    double rate_hz = kUnset, gap_ms = kUnset, latency_ms = kUnset;
    double drops = kUnset;  // messages that were not used
  };
  Sensor lidar_frames{}, radar{};
  std::array<Sensor, 3> lidars{};  // their clouds
  std::array<Sensor, 2> cameras{};
  // Last values from the base, as the radio endpoint stores them; unset before the first.
  struct Uplink {
    bool known = false;                                   // there is a radio
    double stop_latch = kUnset, stop_challenge = kUnset;  // state of the stop latch
    double stop_reason = kUnset;                          // reason of the latched stop
    double authority = kUnset;                            // holder; 0 if none
    bool joystick = false;                                // its samples are live
    bool schema_agrees = false;
  } uplink{};
};

struct TelemetryInputs {
  const Setup& setup;
  const Car& car;
  const Outputs& out;
  const TickLog& log;
  const IoCounters& io;
  Instant now{};
};

telemetry::Snapshot map_telemetry(const TelemetryInputs& in);

}  // namespace pitwall::pipeline
