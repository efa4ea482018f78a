// Faults of a receiver and its inertial unit; set at any time. Noise is drawn all the same, so that
// the samples after a fault are those of a run without it.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "protocol/vocabulary/time.hpp"

namespace pitwall::sensors {

// kNone is sent as the receiver sends it: status "insufficient observations", all numbers zero.
enum class Fix : std::uint8_t { kRtkFixed, kRtkFloat, kSingle, kNone };

struct SolutionFault {
  Fix fix = Fix::kRtkFixed;                        // noise, reported sigma and type
  double float_sigma_m = 0.0;                      // of the float solution; 0: as the unit has it
  double sigma_scale = 1.0;                        // noise and reported sigma
  double noise_scale = 1.0;                        // noise alone: it does not know
  double added_sigma_m = 0.0;                      // noise and reported sigma, in quadrature
  double added_age_s = 0.0;                        // of the corrections
  double east_m = 0.0, north_m = 0.0, up_m = 0.0;  // silent
  double ahead_m = 0.0, left_m = 0.0;              // silent, as the car stands
  double ahead_mps = 0.0, left_mps = 0.0;          // of the velocity, silent
  double heading_rad = 0.0;                        // silent
};

struct StreamFault {
  bool outage = false;  // the unit says nothing at all
  bool heading_outage = false;
  bool position_frozen = false;  // the last position is sent again and again with new times
  bool stamp_frozen = false;     // of positions, velocities and headings
  Duration stamp_shift{};        // likewise; positive: from the future
  Duration added_latency{};      // likewise
  double gaps = 0.0;             // share of their epochs that never come
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
