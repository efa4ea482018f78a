// Set-up of the pipeline before the first tick: the checked parameters of every module, and the
// values derived from them once (track, line, gains, tangent plane). Read-only afterwards.
//   in     CarParams and a TrackDescription, both from files, and the bank of racelines that the
//          car file names
//   out    Setup
//   errors Problem whose place names the parameter or the row
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "protocol/rules/fuel.hpp"
#include "protocol/vocabulary/fixed_vector.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/autonomy/control/control.hpp"
#include "vehicle/autonomy/localization/localization.hpp"
#include "vehicle/autonomy/planning/planning.hpp"
#include "vehicle/autonomy/tracking/params.hpp"
#include "vehicle/gateway/bus_identity.hpp"
#include "vehicle/gateway/handshake.hpp"
#include "vehicle/gateway/inbound.hpp"
#include "vehicle/gateway/outbound.hpp"
#include "vehicle/safety/bus_guard.hpp"
#include "vehicle/safety/frame_gate.hpp"
#include "vehicle/safety/link_loss_policy.hpp"
#include "vehicle/safety/supervisor.hpp"
#include "vehicle/safety/watchdog.hpp"
#include "vehicle/steering/angle_limits.hpp"
#include "vehicle/world/legal_range.hpp"
#include "vehicle/world/raceline.hpp"
#include "vehicle/world/receiver.hpp"
#include "vehicle/world/track_map.hpp"

namespace pitwall::pipeline {

struct Rates {
  Duration tick = milliseconds(10);      // of step(): 100 Hz
  Duration planning = milliseconds(50);  // 20 Hz
};

// Transmit budget of the car on one radio path, including IP and UDP overhead.
struct RadioPathParams {
  double bytes_per_s = 32'000.0;        // 256 kbit/s; [8000, 1250000]
  double packets_per_s = 100.0;         // [10, 1000]
  double safety_bytes_per_s = 4'400.0;  // reserved for safety; [1000, bytes_per_s)
};
inline constexpr std::size_t kRadioPathsMax = 2;

struct RadioParams {
  FixedVector<RadioPathParams, kRadioPathsMax> paths;  // empty: defaults for each path
  bool signed_only = false;  // for venues that forbid encryption; both ends must agree
  safety::LinkLossParams link_loss;
};

struct CarParams {
  double width_m = kUnset;  // over the wheels
  Rates rates;
  gateway::InboundParams inbound;
  gateway::IdentityParams identity;
  gateway::HandshakeParams handshake;
  gateway::OutboundParams outbound;
  world::Receivers receivers;  // not used by step(), but by the receivers' ports
  localization::Params localization;
  tracking::Params tracking;
  planning::Params planning;
  rules::FuelPlan fuel;
  control::Params control;
  safety::WatchdogParams watchdog;
  safety::BusGuardParams bus_guard;
  safety::SupervisorParams supervisor;
  safety::GateParams gate;
  RadioParams radio;
};

inline constexpr auto kFuelRanges = std::to_array<world::NamedRange<rules::FuelPlan>>({
    {"attempt_laps", &rules::FuelPlan::attempt_laps, 1.0, 20.0},
    {"home_laps", &rules::FuelPlan::home_laps, 0.5, 20.0},
    {"reserve_l", &rules::FuelPlan::reserve_l, 0.0, 100.0},
    {"guess_l_per_lap", &rules::FuelPlan::guess_l_per_lap, 0.1, 100.0},
    {"spread", &rules::FuelPlan::spread, 0.0, 1.0},
});

inline constexpr auto kCarRanges = std::to_array<world::NamedRange<CarParams>>({
    {"width_m", &CarParams::width_m, 1.0, 3.0},
});

struct Setup {
  CarParams params;
  world::TrackMap track;
  localization::Datum datum;
  planning::Line line;
  std::vector<planning::Line> other_lines;  // to pass on
  std::optional<planning::PitLine> pit;
  control::LateralGains gains;
  steering::AngleLimits angles{};  // limits of the frame gate, at the road wheel
};

// The frame gate's steering table at the road wheel.
steering::AngleLimits angles_of(const CarParams& params);
// What the car can do on the roads of a track, on tyres of this temperature; warm without one.
envelope::EnvelopeParams envelope_of(const CarParams& params, const world::TrackMap& track,
                                     std::optional<double> tyre_c = std::nullopt);

// `bank` has been checked for this track and car; null if the parameters name none.
Result<Setup, Problem> prepare(const CarParams& params, const world::TrackDescription& track,
                               const world::RacelineBank* bank = nullptr);

}  // namespace pitwall::pipeline
