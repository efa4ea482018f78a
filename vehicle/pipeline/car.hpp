// Complete state of the car's computer as one value: a copy is a snapshot, for rewind and replay.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <type_traits>

#include "protocol/rules/fuel.hpp"
#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/autonomy/control/control.hpp"
#include "vehicle/autonomy/localization/localization.hpp"
#include "vehicle/autonomy/planning/planning.hpp"
#include "vehicle/autonomy/tracking/tracking.hpp"
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

// Last result of planning, kept between its ticks.
struct Plan {
  planning::Output output;
  world::RaceControl made_with;    // flags to acknowledge as acted on
  Instant at{};                    // last attempt
  std::optional<Instant> good_at;  // last attempt that gave trajectories
  bool ever = false;
};

struct Car {
  gateway::InboundState inbound;
  gateway::IdentityState identity;
  gateway::HandshakeState handshake;
  gateway::OutboundState outbound;
  localization::State localization;
  tracking::State tracking;  // of the other cars
  Plan plan;
  control::State control;
  steering::Learned learned;  // learned steering correction
  safety::WatchdogState watchdog;
  safety::BusGuardState bus_guard;
  OperatorOrders orders;
  rules::FuelEstimator fuel;
  safety::LinkLossState link_loss;
  safety::SupervisorState supervisor;
  safety::GateState gate;
  safety::Follow follow = safety::Follow::kNone;  // decided in the last tick
  bool gate_refused = false;                      // in the last tick
  double station_m = kUnset;                      // in the last tick: start of the search
  double bank_rad = 0.0;                          // banking at station_m
  localization::Surroundings surroundings;        // road at the last position
  std::uint64_t ticks = 0;
};
static_assert(std::is_trivially_copyable_v<Car>, "snapshot == memcpy == replay == rewind");

}  // namespace pitwall::pipeline
