// What is wrong now: every cause that holds in this tick, each with the number that crossed its
// limit. Pure; latches nothing but the two instants that "too long" needs.
//   in     signals, bus health, flags, ego state, watchdog rows, verdicts of planning and control
//   out    a set of causes; mode_table decides what they mean
//   errors none
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/safety/fault_log.hpp"
#include "vehicle/safety/watchdog.hpp"
#include "vehicle/world/bus_health.hpp"
#include "vehicle/world/ego_state.hpp"
#include "vehicle/world/race_control.hpp"
#include "vehicle/world/signals.hpp"

namespace pitwall::safety {

struct FaultParams {
  Duration dead_reckoning_max = milliseconds(1500);  // [0.1, 10] s
  Duration bus_silence_max = milliseconds(100);      // no frame at all; [20 ms, 1 s]
  double position_sigma_max_m = 1.0;                 // [0.1, 10]
  std::uint8_t control_failures = 3;                 // ticks in a row; [1, 20]
  std::uint8_t refused_ticks = 3;                    // ticks in a row with a refused frame; [1, 20]
  bool radio_loss_stops = true;                      // base station lost for the watchdog's limit
  bool race_control_required = true;
};

// What the operator asks, as levels. `stop` and `emergency_stop` act while they are held and their
// effect stays by the modes; `reset` acts on its rising edge.
struct OperatorRequests {
  bool arm = false, reset = false, stop = false, emergency_stop = false;
};

struct FaultInputs {
  const world::VehicleSignals& signals;
  const world::BusHealth& bus;
  const world::RaceControl& race_control;
  const world::EgoState& ego;
  const WatchdogOutput& watchdog;
  OperatorRequests operator_requests;
  bool own_id_seen = false;   // gateway::InboundOutput
  bool bus_failed = false;    // BusGuardOutput
  bool control_ok = false;    // control gave a command this tick
  bool gate_refused = false;  // the gate refused a frame of the previous tick
  bool driving = false;       // control is expected to give commands
};

struct FaultState {
  bool positioned = false;  // ego was good once
  Instant last_good{};      // ego state last good
  std::uint8_t control_failed_ticks = 0, gate_refused_ticks = 0;
};

struct FaultOutput {
  CauseSet causes;
  std::array<double, kCauses> values{};  // per cause that holds
};

FaultOutput detect(const FaultParams& params, FaultState& state, const FaultInputs& inputs,
                   Instant now);

// The car's speed by its wheels: the mean of the two middle ones of four, so that one wheel that
// locks, spins or lies has no say. Unset if older than `limit` or a wheel is not a number.
double wheel_speed_mps(const world::VehicleSignals& signals, Instant now, Duration limit);

}  // namespace pitwall::safety
