// Faults of a receiver and its inertial unit; they can be set at any time. Noise is drawn even
// during a fault, so that the samples after it equal those of a run without the fault.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "protocol/vocabulary/time.hpp"

namespace pitwall::sensors {

// kNone is sent as the receiver does: status "insufficient observations", all numbers zero.
enum class Fix : std::uint8_t { kRtkFixed, kRtkFloat, kSingle, kNone };

struct SolutionFault {
  Fix fix = Fix::kRtkFixed;                        // sets noise, reported sigma and type
  double float_sigma_m = 0.0;                      // of the float solution; 0: that of the unit
  double sigma_scale = 1.0;                        // scales noise and reported sigma
  double noise_scale = 1.0;                        // scales the noise, not the reported sigma
  double added_sigma_m = 0.0;                      // noise and reported sigma, in quadrature
  double added_age_s = 0.0;                        // added to the age of the corrections
  double east_m = 0.0, north_m = 0.0, up_m = 0.0;  // position offset, sigma unchanged
  double ahead_m = 0.0, left_m = 0.0;              // the same, in the directions of the car
  double ahead_mps = 0.0, left_mps = 0.0;          // velocity offset, sigma unchanged
  double heading_rad = 0.0;                        // heading offset, sigma unchanged
};

struct StreamFault {
  bool outage = false;  // the unit sends nothing at all
  bool heading_outage = false;
  bool position_frozen = false;  // the last position is repeated with new times
  bool stamp_frozen = false;     // of positions, velocities and headings
  Duration stamp_shift{};        // likewise; positive: into the future
  Duration added_latency{};      // likewise
  double gaps = 0.0;             // share of their epochs that are not sent
  bool not_a_number = false, negative_sigma = false;
};

struct ImuFault {
  bool outage = false, frozen = false, not_a_number = false;
  double yaw_rate_bias_rad_per_s = 0.0;
  double ahead_bias_mps2 = 0.0, left_bias_mps2 = 0.0;
  double gyro_scale = 1.0;
};

struct UnitFault {
  SolutionFault solution{};
  StreamFault stream{};
  ImuFault imu{};
};

}  // namespace pitwall::sensors
