// Where the car is: an extended Kalman filter over two GNSS units with dual-antenna heading, the IMU
// and the wheel speeds, with late measurements put back where they belong in time.
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
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"
#include "vehicle/autonomy/localization/datum.hpp"
#include "vehicle/autonomy/localization/ekf.hpp"
#include "vehicle/autonomy/localization/timeline.hpp"
#include "vehicle/world/ego_state.hpp"
#include "vehicle/world/sensor_input.hpp"
#include "vehicle/world/signals.hpp"

namespace pitwall::localization {

struct UnitParams {
  LeverArm antenna;                  // of the primary antenna, from the centre of gravity: +-5 m
  double baseline_yaw_rad = kUnset;  // -pi..pi: direction of the antenna baseline in Body, from x
                                     // counter-clockwise
};

struct Params {
  std::array<UnitParams, world::kGnssUnits> units;
  TimelineParams timeline;
  double position_sigma_floor_m = kUnset;   // 0.001..1: added to the receiver's own figure
  double position_sigma_max_m = kUnset;     // 0.05..20: a worse solution is refused
  double velocity_sigma_mps = kUnset;       // 0.01..2
  double heading_sigma_floor_rad = kUnset;  // 0.0005..0.2
  double heading_sigma_max_rad = kUnset;    // 0.005..0.5: a worse solution is refused
  double wheel_sigma_mps = kUnset;          // 0.01..2
  double wheel_sigma_per_speed = kUnset;    // 0..0.1: share of the speed (slip, tyre growth)
  double slip_sigma_mps = kUnset;           // 0.05..5: of the lateral speed by the tyre model
  double slip_after_s = kUnset;             // 0.05..5: without GNSS velocity the model is used
  double cg_to_rear_m = kUnset;             // 0.5..3
  double rear_slip_rad_per_mps2 = kUnset;   // 0..0.02: rear slip angle per lateral acceleration
  double imu_timeout_s = kUnset;            // 0.02..0.5: then the other unit's IMU
  double good_age_max_s = kUnset;           // 0.1..2: of the last position for kGood
  double dead_reckoning_max_s = kUnset;     // 0.5..20: then kLost
  double good_sigma_max_m = kUnset;         // 0.05..5
  double lost_sigma_max_m = kUnset;         // 0.5..50
  double reset_after_s = kUnset;            // 0.5..10: positions refused so long restart the filter
};

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
  kStandby  // kStandby: healthy, but another unit is in use (IMU)
};
inline constexpr std::size_t kGates = 11;

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
  Instant last_wheel{};
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
  State next;
};

// Start-up: every parameter against its legal range; the place is the parameter's name.
Result<Params, Problem> checked(const Params& params);

Output step(const Params& params, const Datum& datum, const State& state,
            const world::SensorInput& sensors, const world::VehicleSignals& signals,
            double bank_rad, Instant now);

}  // namespace pitwall::localization
