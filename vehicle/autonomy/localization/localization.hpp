// Where the car is: an extended Kalman filter over two GNSS units with dual-antenna heading, the
// IMU and the wheel speeds, with late measurements put back where they belong in time.
//   in     SensorInput (WGS 84, Body), VehicleSignals, banking of the road at the last estimate
//   out    EgoState at `now`, always; a verdict per sample; next state
//   rate   100 Hz
//   frames Map: tangent plane of the Datum. Body: origin at the centre of gravity
//   errors a sample is refused with its reason and changes nothing. No position for a while:
//          kDeadReckoning, then kLost. Before the first position with a heading: kNever
//   cost   O(samples * timeline), typically below 50 us; no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "protocol/vocabulary/fixed_vector.hpp"
#include "protocol/vocabulary/time.hpp"
#include "vehicle/autonomy/localization/datum.hpp"
#include "vehicle/autonomy/localization/params.hpp"
#include "vehicle/autonomy/localization/timeline.hpp"
#include "vehicle/world/ego_state.hpp"
#include "vehicle/world/monitor.hpp"
#include "vehicle/world/sensor_input.hpp"
#include "vehicle/world/signals.hpp"

namespace pitwall::localization {

enum class Source : std::uint8_t { kPosition, kVelocity, kHeading, kImu, kWheelSpeed };
inline constexpr std::size_t kSources = 5;

enum class Gate : std::uint8_t {
  kUnknown,
  kAccepted,
  kNotFinite,
  kUnknownUnit,
  kNotSolved,
  kTooUncertain,
  kTooOld,
  kFromTheFuture,
  kOutlier,
  kNotStarted,
  kStandby,     // healthy, but another unit is in use (IMU)
  kImplausible  // finite, but nothing that a car on a track can do or a receiver can mean
};
inline constexpr std::size_t kGates = 12;

struct Verdict {
  Source source = Source::kPosition;
  std::uint8_t unit = 0;
  Gate gate = Gate::kUnknown;
  double nis = kUnset;
  double age_s = kUnset;
};

// Since the start; one row per source and unit (wheel speed is unit 0).
struct Tally {
  std::array<std::uint32_t, kGates> by_gate{};
  Instant last_accepted{};
  bool ever_accepted = false;
};

struct State {
  bool started = false;
  Timeline timeline;
  std::array<std::array<Tally, world::kGnssUnits>, kSources> tally{};
  world::GnssPosition seed_position;  // latest good ones, to start from
  world::GnssHeading seed_heading;
  world::GnssVelocity seed_velocity;
  bool have_position = false, have_heading = false, have_velocity = false;
  double wheel_accel_mps2 = 0.0;  // low-passed: the longitudinal force when no IMU says it
  Instant last_wheel{};
  bool have_wheel = false;
  double wheel_mps = 0.0;
  Instant refused_since{};  // positions refused without a break
  bool refusing = false;
  std::uint32_t restarts = 0;
};

inline constexpr std::size_t kVerdictsMax =
    64;  // every sample that fits in a SensorInput, + wheels

struct Output {
  world::EgoState ego;
  FixedVector<Verdict, kVerdictsMax> verdicts;
  double gyro_bias_rad_per_s = kUnset;
  double position_age_s = kUnset;  // since the last accepted position was true
  double imu_age_s = kUnset;
  State next;
  world::MonitorSet seen{};  // monitors that see something wrong now
};

Output step(const Params& params, const Datum& datum, const State& state,
            const world::SensorInput& sensors, const world::VehicleSignals& signals,
            double bank_rad, Instant now);

}  // namespace pitwall::localization
