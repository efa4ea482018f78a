// The whole state of the car's computer as one value: copying it is a snapshot, a rewind, a replay.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <type_traits>

#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/autonomy/control/control.hpp"
#include "vehicle/autonomy/localization/localization.hpp"
#include "vehicle/autonomy/planning/planning.hpp"
#include "vehicle/gateway/bus_identity.hpp"
#include "vehicle/gateway/handshake.hpp"
#include "vehicle/gateway/inbound.hpp"
#include "vehicle/gateway/outbound.hpp"
#include "vehicle/pipeline/operator_orders.hpp"
#include "vehicle/safety/bus_guard.hpp"
#include "vehicle/safety/frame_gate.hpp"
#include "vehicle/safety/link_loss_policy.hpp"
#include "vehicle/safety/supervisor.hpp"
#include "vehicle/safety/watchdog.hpp"
#include "vehicle/steering/learned_steering.hpp"
#include "vehicle/world/race_control.hpp"

namespace pitwall::pipeline {

// What planning said last, kept between its ticks.
struct Plan {
  planning::Output output;
  world::RaceControl made_with;    // to be acknowledged: acted on, not merely received
  Instant at{};                    // of the last attempt
  std::optional<Instant> good_at;  // of the last that gave a trajectory
  bool ever = false;
};

struct Car {
  gateway::InboundState inbound;
  gateway::IdentityState identity;
  gateway::HandshakeState handshake;
  gateway::OutboundState outbound;
  localization::State localization;
  Plan plan;
  control::State control;
  steering::Learned learned;  // of the car's steering
  safety::WatchdogState watchdog;
  safety::BusGuardState bus_guard;
  OperatorOrders orders;
  safety::LinkLossState link_loss;
  safety::SupervisorState supervisor;
  safety::GateState gate;
  safety::Follow follow = safety::Follow::kNone;  // decided by the last tick
  bool gate_refused = false;                      // in the last tick
  double station_m = kUnset;                      // of the last tick: where to search from
  double bank_rad = 0.0;                          // there
  localization::Surroundings surroundings;        // likewise
  std::uint64_t ticks = 0;
};
static_assert(std::is_trivially_copyable_v<Car>, "snapshot == memcpy == replay == rewind");

}  // namespace pitwall::pipeline
