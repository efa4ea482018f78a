// Measurement of any source in the form that the filters of localization take, and its innovation.
//   frames Map: ENU at the datum, z up. Body: ISO 8855, origin at the centre of gravity. Yaw from
//          east, counter-clockwise; roll positive left side up; pitch positive nose down
//   invariants
//          sigma_* is exactly what the sensor reports: floors and models of correlated noise are in
//          the filter. Unset if the sensor reports none
//   errors none here; a filter refuses with Innovation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::localization {

// In the order of evaluation at one instant.
enum class Kind : std::uint8_t {
  kNone,
  kImu,         // imu, at `arm`; the filter fills unset values from the road
  kWiden,       // no measurement: adds variance to the position, sigma_a east and sigma_b north
  kPosition,    // a, b, c: east, north, up [m] of the antenna at `arm`; c may be unset
  kVelocity,    // a, b, c: east, north, up [m/s] of the antenna at `arm`; c may be unset
  kHeading,     // a: azimuth of the antenna baseline minus direction_rad, the direction of the
                // baseline in Body; for a level car this is the yaw
  kWheelSpeed,  // a: forward speed from the rear wheels [m/s]; sigma_b: relative scale error
  kSlip,        // lateral speed of the rear axle by the tyre model, no values
  kRoad,        // road: the car is on its surface and moves along it
  kAttitude     // a, b, c: roll, pitch, yaw [rad] from a receiver's inertial solution; c may be
                // unset
};

struct LeverArm {  // from the centre of gravity, Body
  double x_m = 0.0, y_m = 0.0, z_m = 0.0;
};

struct Imu {  // Body x, y, z
  std::array<double, 3> rate_rad_per_s{kUnset, kUnset, kUnset};
  std::array<double, 3> force_mps2{kUnset, kUnset, kUnset};  // specific force
};

// Road surface at a position of the map. Bank positive where the left side is lower, climb positive
// uphill, both in `direction_rad`, the direction of the reference line in Map.
struct Road {
  double x_m = kUnset, y_m = kUnset;  // position of the look-up
  double height_m = kUnset;           // height of the surface, Map
  double bank_rad = kUnset, climb_rad = kUnset, direction_rad = kUnset;
};

struct Measurement {
  Kind kind = Kind::kNone;
  std::uint8_t unit = 0;  // GNSS or IMU unit
  Instant at{};           // time of measurement
  double a = kUnset, b = kUnset, c = kUnset;
  double sigma_a = kUnset, sigma_b = kUnset, sigma_c = kUnset;
  LeverArm arm{};
  double direction_rad = 0.0;
  Imu imu{};
  Road road{};
};

struct Innovation {
  bool accepted = false;
  double nis = kUnset;  // normalised innovation squared, chi-square with `size` degrees of freedom
  int size = 0;
};

// Step sizes of the integration between two samples, common to both filters.
inline constexpr double kStepMax_s = 0.02;  // longer intervals are divided
inline constexpr double kGapMax_s = 1.0;    // longer gaps are not integrated but add variance
inline constexpr double kGapSigma_m = 100.0;

}  // namespace pitwall::localization
