// Measurement of any source, as the filters of localization take it, and what became of it.
//   frames Map: ENU at the datum, z up. Body: ISO 8855, origin at the centre of gravity. Yaw from
//          east, counter-clockwise; roll positive left side up; pitch positive nose down
//   invariants
//          sigma_* is what the sensor says of itself and nothing else: floors and models of
//          correlated noise belong to the filter. Unset where the sensor does not say
//   errors none here; a filter refuses with Innovation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::localization {

// In this order at one instant.
enum class Kind : std::uint8_t {
  kNone,
  kImu,       // imu, at `arm`; what is unset in it the filter fills from the road
  kWiden,     // measures nothing: takes confidence in the position away, sigma_a east and
              // sigma_b north
  kPosition,  // a, b, c: east, north, up [m] of the antenna at `arm`; c may be unset
  kVelocity,  // a, b, c: east, north, up [m/s] of the antenna at `arm`; c may be unset
  kHeading,   // a: azimuth of the antenna baseline less direction_rad, which is the baseline's own
              // direction in Body: the yaw, where the car is level
  kWheelSpeed,  // a: forward speed by the rear wheels [m/s]; sigma_b: of its scale, a share
  kSlip,        // the rear axle slips as its tyres do: lateral speed by a model, no numbers
  kRoad,        // road: the car stands on it and moves along it
  kAttitude     // a, b, c: roll, pitch, yaw [rad] by a receiver's own inertial solution; c may be
                // unset
};

struct LeverArm {  // from the centre of gravity, Body
  double x_m = 0.0, y_m = 0.0, z_m = 0.0;
};

struct Imu {  // Body x, y, z
  std::array<double, 3> rate_rad_per_s{kUnset, kUnset, kUnset};
  std::array<double, 3> force_mps2{kUnset, kUnset, kUnset};  // specific force
};

// The surface under a place of the map. Bank positive where the left side is lower, climb positive
// uphill, both seen along `direction_rad`, the direction of the reference line in Map.
struct Road {
  double x_m = kUnset, y_m = kUnset;  // where it was looked up
  double height_m = kUnset;           // of the surface, Map
  double bank_rad = kUnset, climb_rad = kUnset, direction_rad = kUnset;
};

struct Measurement {
  Kind kind = Kind::kNone;
  std::uint8_t unit = 0;  // of GNSS and IMU
  Instant at{};           // when it was true
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

}  // namespace pitwall::localization
