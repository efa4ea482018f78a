// Tick of the whole car: decode -> localize -> track -> plan -> control -> supervise -> encode ->
// gate. One function for the car, the live bench, lockstep and the tests.
//   in     Setup (read-only), what arrived since the last tick, the operator's requests, the time
//   out    frames for the bus, and all values for telemetry and logs; Car is updated in place
//   rate   100 Hz (Setup::params.rates.tick); planning inside at its own rate
//   errors none: bad input is counted by the module that refuses it
//   cost   no allocation, no lock, no throw; below 100 us, and below 1.2 ms in a tick that plans or
//          inserts late measurements
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
#include "vehicle/world/detection.hpp"
#include "vehicle/world/health.hpp"
#include "vehicle/world/monitor.hpp"
#include "vehicle/world/operator_inputs.hpp"
#include "vehicle/world/opponent.hpp"
#include "vehicle/world/sensor_input.hpp"

namespace pitwall::pipeline {

// View of the guardian (made from its Status in guardian_interface.hpp). While the guardian drives,
// the car sends nothing; afterwards it continues from the guardian's last frames.
struct GuardianView {
  bool drives = false;                  // drives now, with a fresh status
  bool stopped = false;                 // it stopped this run: no driving until a reset
  Instant drove_from{}, drove_until{};  // last takeover
  guardian::CommandCounters counters;
  world::ActuatorCommand command;
};

struct Inputs {
  Instant now{};
  Duration dt{};  // since the last tick
  std::span<const can::ReceivedFrame> can;
  const world::SensorInput& sensors;
  std::span<const world::DetectionFrame> detections{};  // of other cars, in order of arrival
  safety::OperatorRequests requests;                    // switches at the car
  double operator_speed_limit_mps = kUnset;             // unset: none
  world::OperatorInputs operator_inputs{};              // by radio
  std::span<const world::OperatorCommand> commands{};   // at most kOperatorCommandsMax
  bool may_arm = true;                                  // false: listen-only bus or wrong schema
  // Newest byte of each receiver; nullopt: any sample of the unit counts.
  std::array<std::optional<Instant>, world::kGnssUnits> gnss_byte_at{};
  world::LinkObservation link{};      // of the CAN interface
  std::optional<Instant> radio_at{};  // newest authentic packet of the base station
  GuardianView guardian{};
  world::ComputerHealth computer{};  // unset if not measured
  bool last_run_armed = false;       // the previous process ended while armed
};

// Deviation from the trajectory that is followed, whether control or a stop drives.
struct Tracking {
  double cross_track_m = kUnset, heading_error_rad = kUnset;  // left positive
  double target_speed_mps = kUnset;
};

struct Outputs {
  gateway::InboundOutput received;
  world::EgoState ego;
  FixedVector<localization::Verdict, localization::kVerdictsMax> located;
  localization::Estimate estimate;                                     // source of `ego`
  std::array<localization::UnitSet, localization::kSources> in_use{};  // channels and units
  world::Curvilinear place;    // on the track; unset before the first position
  world::Opponents opponents;  // other cars
  control::Output steered;     // empty in a stop: control is not used
  Tracking tracking;
  safety::WatchdogOutput watchdog;
  safety::BusGuardOutput bus_guard;
  safety::SupervisorOutput chosen;
  world::CtState ct_state = world::CtState::kDefault;
  safety::GateOutput passed;
  bool quiet = false;                 // the guardian drives: nothing was sent
  safety::OperatorRequests requests;  // switches and radio combined, as applied
  safety::LinkLossOutput radio;
  world::RaceControl race_control;  // acted on: as received, or stricter by the base's flag
  double speed_limit_mps = kUnset;  // of operator and link-loss policy; unset: no limit
  Answers answers;                  // to commands of this and the previous tick
  world::MonitorSet seen{};         // by all monitors
};

Outputs step(const Setup& setup, Car& car, const Inputs& in);

// Union of the findings of all monitors in one tick: each is reported by the modules that
// world/monitor.hpp names for it.
world::MonitorSet findings_of(const Outputs& out, world::MonitorSet by_localization);

}  // namespace pitwall::pipeline
