// Localization of the car. It checks every sample of two GNSS units with dual-antenna heading,
// their IMUs and the wheels with a table of checks, selects the unit and the source, and runs the
// filter that fuses them.
//
//     sample -> form, time, solution, prediction, other unit -> trust -> preference -> filter
//
//   in     SensorInput (WGS 84, Body), VehicleSignals, the road at the last estimate, the sensors
//          that the operator has excluded
//   out    EgoState at `now` in every tick; a verdict with its reason per sample, counts by reason,
//          the monitors with a finding; the state is updated in place
//   rate   100 Hz, whether or not samples arrive
//   frames Map: tangent plane of the Datum. Body: origin at the centre of gravity
//   invariants
//          a refused or excluded sample changes no estimate; a unit that was refused enters again
//          only after it was consistent for a while. Exchanging the units, with their parameters,
//          exchanges the result
//   errors without a position for a while: kDeadReckoning, then kLost. Before the first position
//          with a heading: kNever
//   cost   O(samples * window of the filter); no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <type_traits>

#include "protocol/vocabulary/fixed_vector.hpp"
#include "protocol/vocabulary/time.hpp"
#include "vehicle/autonomy/localization/checks/drift_watch.hpp"
#include "vehicle/autonomy/localization/checks/imu_watch.hpp"
#include "vehicle/autonomy/localization/checks/verdict.hpp"
#include "vehicle/autonomy/localization/checks/wheel_scale.hpp"
#include "vehicle/autonomy/localization/checks/wheel_watch.hpp"
#include "vehicle/autonomy/localization/datum.hpp"
#include "vehicle/autonomy/localization/filter/filter.hpp"
#include "vehicle/autonomy/localization/params.hpp"
#include "vehicle/autonomy/localization/stream.hpp"
#include "vehicle/autonomy/localization/trail.hpp"
#include "vehicle/steering/learned_steering.hpp"
#include "vehicle/world/ego_state.hpp"
#include "vehicle/world/monitor.hpp"
#include "vehicle/world/operator_inputs.hpp"
#include "vehicle/world/sensor_input.hpp"
#include "vehicle/world/signals.hpp"

namespace pitwall::localization {

// Road at the last estimated position; unset if it is not known.
struct Surroundings {
  Road road;
  Instant at{};                 // time of that estimate
  steering::Learned learned{};  // learned steering correction
};

// Wheel speeds, checked and corrected.
struct WheelState {
  WheelWatch watch;
  WheelScale scale;
  bool received = false;
  Instant at{};               // newest report
  double speed_mps = kUnset;  // with the scale error removed
  double accel_mps2 = 0.0;    // low-passed; replaces the longitudinal force without an IMU
  Gate verdict = Gate::kUnknown;
  world::MonitorSet seen{};
};

struct State {
  bool started = false;
  FilterState filter;
  Streams streams;
  Tallies tally{};
  Trail trail;
  DriftWatch drift;
  ImuWatch imu;
  WheelState wheels;
  std::array<world::ReceiverHealth, world::kGnssUnits> receivers{};
  world::GnssPosition seed_position;  // latest good samples, for the start
  world::GnssHeading seed_heading;
  world::GnssVelocity seed_velocity;
  bool have_position = false, have_heading = false, have_velocity = false;
  Instant road_at{};        // of the last road measurement
  Instant stepped_at{};     // last tick
  Instant refused_since{};  // start of uninterrupted refusals of positions
  bool refusing = false;
  std::uint32_t restarts = 0;
};
static_assert(std::is_trivially_copyable_v<State>);

// Every sample of a full SensorInput, and the wheels.
inline constexpr std::size_t kVerdictsMax = 80;

// Units that recently fed a channel: bit k is unit k.
using UnitSet = std::uint8_t;

struct Output {
  world::EgoState ego;
  FixedVector<Verdict, kVerdictsMax> verdicts;
  Estimate estimate;  // source of `ego`; unset before the start
  std::array<UnitSet, kSources> in_use{};
  double position_age_s = kUnset;  // age of the last accepted position
  double imu_age_s = kUnset;
  world::MonitorSet seen{};  // monitors with a finding in this tick
};

Output step(const Params& params, const Datum& datum, State& state,
            const world::SensorInput& sensors, const world::VehicleSignals& signals,
            const Surroundings& surroundings, world::SensorUse use, Instant now);

}  // namespace pitwall::localization
