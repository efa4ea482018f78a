// Executive of localization. It holds every sample of two GNSS units with dual-antenna heading,
// their IMUs and the wheels against a table of checks, decides which unit and which source may
// enter, and keeps the filter that fuses them.
//
//     sample -> form, time, solution, prediction, other unit -> trust -> preference -> filter
//
//   in     SensorInput (WGS 84, Body), VehicleSignals, the road at the last estimate, what the
//          operator has excluded
//   out    EgoState at `now`, always; a verdict with its reason per sample, tallies by reason, the
//          monitors that see something wrong; the state goes on in place
//   rate   100 Hz, whatever arrives
//   frames Map: tangent plane of the Datum. Body: origin at the centre of gravity
//   invariants
//          a refused or excluded sample changes no estimate; a unit that was refused enters again
//          only after it was consistent for a while. Exchanging the units, and what the parameters
//          say of them, exchanges the result
//   errors no position for a while: kDeadReckoning, then kLost. Before the first position with a
//          heading: kNever
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
#include "vehicle/world/sensor_input.hpp"
#include "vehicle/world/sensor_use.hpp"
#include "vehicle/world/signals.hpp"

namespace pitwall::localization {

// The road where the car was last estimated to be; unset where nobody knows yet.
struct Surroundings {
  Road road;
  Instant at{};                 // of that estimate
  steering::Learned learned{};  // of the car's steering
};

// The rear wheels' account of the car.
struct WheelState {
  WheelWatch watch;
  WheelScale scale;
  bool received = false;
  Instant at{};               // of the newest report
  double speed_mps = kUnset;  // without the error of the wheels' scale
  double accel_mps2 = 0.0;    // low-passed: the longitudinal force when no IMU says it
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
  world::GnssPosition seed_position;  // latest good ones, to start from
  world::GnssHeading seed_heading;
  world::GnssVelocity seed_velocity;
  bool have_position = false, have_heading = false, have_velocity = false;
  Instant road_at{};        // of the road that was taken in last
  Instant stepped_at{};     // the last tick
  Instant refused_since{};  // positions refused without a break
  bool refusing = false;
  std::uint32_t restarts = 0;
};
static_assert(std::is_trivially_copyable_v<State>);

inline constexpr std::size_t kVerdictsMax =
    80;  // every sample that fits in a SensorInput, + wheels

// Which units a channel was fed by lately: bit k is unit k.
using UnitSet = std::uint8_t;

struct Output {
  world::EgoState ego;
  FixedVector<Verdict, kVerdictsMax> verdicts;
  Estimate estimate;  // what ego is made of; unset before the start
  std::array<UnitSet, kSources> in_use{};
  double position_age_s = kUnset;  // since the last accepted position was true
  double imu_age_s = kUnset;
  world::MonitorSet seen{};  // monitors that see something wrong now
};

Output step(const Params& params, const Datum& datum, State& state,
            const world::SensorInput& sensors, const world::VehicleSignals& signals,
            const Surroundings& surroundings, world::SensorUse use, Instant now);

}  // namespace pitwall::localization
