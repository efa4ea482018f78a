// Samples of the sensors that are not on the CAN bus, as the receivers report them. Geodetic
// positions are WGS 84; rates and accelerations are in the frame of the car (ISO 8855: x forward, y
// left, z up).
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "protocol/vocabulary/fixed_vector.hpp"
#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::world {

inline constexpr std::size_t kGnssUnits = 2;

// NovAtel OEM7 solution status 0 is "computed"; position types: 50 narrow-int (RTK fixed),
// 34 narrow-float, 16 single, 0 none.
inline constexpr std::uint32_t kSolutionComputed = 0;
inline constexpr std::uint32_t kPositionNone = 0, kPositionSingle = 16, kPositionNarrowFloat = 34,
                               kPositionNarrowInt = 50;

struct GnssPosition {
  std::uint8_t unit = 0;
  Instant at{};  // time of validity, on the car's clock
  std::uint32_t solution_status = 1, position_type = kPositionNone;
  double latitude_deg = kUnset, longitude_deg = kUnset, height_m = kUnset;
  double latitude_sigma_m = kUnset, longitude_sigma_m = kUnset, height_sigma_m = kUnset;
  std::uint8_t satellites = 0;
  double differential_age_s = kUnset, solution_age_s = kUnset;
};

struct GnssVelocity {
  std::uint8_t unit = 0;
  Instant at{};
  std::uint32_t solution_status = 1, velocity_type = kPositionNone;
  double horizontal_mps = kUnset;
  double track_over_ground_rad = kUnset;  // from true north, clockwise, as in BESTVEL
  double vertical_mps = kUnset;
  double sigma_mps = kUnset;  // per axis; unset if not reported
};

struct GnssHeading {
  std::uint8_t unit = 0;
  Instant at{};
  std::uint32_t solution_status = 1, position_type = kPositionNone;
  double heading_rad = kUnset;  // of the antenna baseline, from true north, clockwise
  double heading_sigma_rad = kUnset;
  double baseline_m = kUnset;  // measured; unset if not reported
};

// Attitude from the receiver's own inertial solution, for comparison and as heading while the
// antennas give none.
enum class InsStatus : std::uint8_t { kInactive, kAligning, kHighVariance, kGood, kFree };
struct InsAttitude {
  std::uint8_t unit = 0;
  Instant at{};
  InsStatus status = InsStatus::kInactive;
  double roll_rad = kUnset, pitch_rad = kUnset;  // ISO 8855: left side up, nose down positive
  double heading_rad = kUnset;                   // from true north, clockwise
  double roll_sigma_rad = kUnset, pitch_sigma_rad = kUnset, heading_sigma_rad = kUnset;
};

// Status that a receiver reports.
struct ReceiverHealth {
  std::uint8_t unit = 0;
  Instant at{};
  bool error = false;  // its error word is not zero
  std::uint32_t error_word = 0, status_word = 0;
  bool time_valid = true;
};

struct ImuSample {
  std::uint8_t unit = 0;
  Instant at{};
  std::array<double, 3> rate_rad_per_s{kUnset, kUnset, kUnset};       // x roll, y pitch, z yaw
  std::array<double, 3> specific_force_mps2{kUnset, kUnset, kUnset};  // x, y, z
};

// Time report of a receiver, with the car's time of its arrival.
struct ReceiverTime {
  std::uint8_t unit = 0;
  Instant received{};            // arrival of the bytes, on the car's clock
  std::int64_t gps_ns = 0;       // since the GPS epoch; without leap seconds
  double utc_offset_s = kUnset;  // UTC minus GPS time; unset if not reported
};

// Samples since the last step, in order of arrival.
struct SensorInput {
  FixedVector<GnssPosition, 8> positions;
  FixedVector<GnssVelocity, 8> velocities;
  FixedVector<GnssHeading, 8> headings;
  FixedVector<ImuSample, 32> imu;
  FixedVector<InsAttitude, 16> attitudes;
  FixedVector<ReceiverHealth, 8> receivers;
  FixedVector<ReceiverTime, 8> times;
  std::uint32_t overflows = 0;  // samples that did not fit into their list
};

}  // namespace pitwall::world
