// The whole car on one screen: decode -> localize -> plan -> control -> supervise -> encode ->
// gate.
// One function for the car, the live bench, lockstep and the tests.
//   in     Setup (read-only), what arrived since the last tick, what the operator asks, now
//   out    frames for the bus, and everything that telemetry and logs show; Car is updated in place
//   rate   100 Hz (Setup::params.rates.tick); planning inside at its own rate
//   errors none: bad input is counted by the module that refuses it
//   cost   no allocation, no lock, no throw; below 100 us, and below 1.2 ms where it plans or
//          puts late measurements in their place
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <span>

#include "protocol/can/frame.hpp"
#include "protocol/vocabulary/time.hpp"
#include "vehicle/guardian/record.hpp"
#include "vehicle/pipeline/car.hpp"
#include "vehicle/pipeline/operator_orders.hpp"
#include "vehicle/pipeline/setup.hpp"
#include "vehicle/safety/link_loss_policy.hpp"
#include "vehicle/world/computer_health.hpp"
#include "vehicle/world/monitor.hpp"
#include "vehicle/world/operator_inputs.hpp"
#include "vehicle/world/sensor_input.hpp"

namespace pitwall::pipeline {

// What the car heeds of its guardian (guarding.hpp makes it of the guardian's Status). While the
// guardian drives the car is quiet; what the guardian said last is what it goes on from.
struct GuardianView {
  bool drives = false;                  // now, and it lives
  bool stopped = false;                 // it stopped this run: the car stands until a reset
  Instant drove_from{}, drove_until{};  // the last time
  guardian::CommandCounters counters;
  world::ActuatorCommand command;
};

struct Inputs {
  Instant now{};
  Duration dt{};  // since the last tick
  std::span<const can::ReceivedFrame> can;
  const world::SensorInput& sensors;
  safety::OperatorRequests requests;                   // switches at the car
  double operator_speed_limit_mps = kUnset;            // unset: none
  world::OperatorInputs operator_inputs{};             // by radio
  std::span<const world::OperatorCommand> commands{};  // at most kOperatorCommandsMax
  bool may_arm = true;                                 // false: listens only
  // Newest byte of each receiver, where the rim knows it; else any sample of the unit counts.
  std::array<std::optional<Instant>, world::kGnssUnits> gnss_byte_at{};
  world::LinkObservation link{};      // of the CAN interface, by the rim
  std::optional<Instant> radio_at{};  // newest authentic packet of the base station
  GuardianView guardian{};
  world::ComputerHealth computer{};  // where the rim knows it
  bool last_run_armed = false;       // the process before this one ended while it was armed
};

// How the car stands to the trajectory that it follows, whoever drives.
struct Tracking {
  double cross_track_m = kUnset, heading_error_rad = kUnset;  // left positive
  double target_speed_mps = kUnset;
};

struct Outputs {
  gateway::InboundOutput received;
  world::EgoState ego;
  FixedVector<localization::Verdict, localization::kVerdictsMax> located;
  localization::Estimate estimate;                                     // what ego is made of
  std::array<localization::UnitSet, localization::kSources> in_use{};  // channels and units
  world::Curvilinear place;  // on the track; unset before the first position
  control::Output steered;   // empty in a stop: control is not asked
  Tracking tracking;
  safety::WatchdogOutput watchdog;
  safety::BusGuardOutput bus_guard;
  safety::SupervisorOutput chosen;
  world::CtState ct_state = world::CtState::kDefault;
  safety::GateOutput passed;
  bool quiet = false;                 // the guardian drives: nothing was said
  safety::OperatorRequests requests;  // switches and radio together, as they were heeded
  safety::LinkLossOutput radio;
  world::RaceControl race_control;  // acted on: what was heard, or stricter by the base's flag
  double speed_limit_mps = kUnset;  // of operator and radio ladder; unset: none
  Answers answers;                  // to commands of this tick and of the one before
  world::MonitorSet seen{};         // all monitors of the car: monitoring.hpp
};

Outputs step(const Setup& setup, Car& car, const Inputs& in);

}  // namespace pitwall::pipeline
