// Other cars as the tracker knows them.
//   frames Map, as EgoState; yaw is the direction of motion; station and offset as TrackMap has
//          them, unset without a map
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "protocol/vocabulary/fixed_vector.hpp"
#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::world {

struct Opponent {
  std::uint32_t id = 0;  // of the track, never used again
  double x_m = kUnset, y_m = kUnset, yaw_rad = kUnset;
  double speed_mps = kUnset, accel_mps2 = kUnset, yaw_rate_rad_per_s = kUnset;
  double s_m = kUnset, n_m = kUnset;
  double length_m = kUnset, width_m = kUnset;
  // Of x, y, yaw, speed; row by row.
  std::array<double, 16> covariance{};
  Instant born_at{};
  Instant measured_at{};  // newest detection that belongs to it; later it only coasts
  double confidence = kUnset;
};

// Larger semi-axis of the error ellipse, as EgoState has it.
inline double position_sigma_m(const Opponent& car) {
  const double xx = car.covariance[0], xy = car.covariance[1], yy = car.covariance[5];
  return std::sqrt(0.5 * (xx + yy) + std::hypot(0.5 * (xx - yy), xy));
}

inline constexpr std::size_t kOpponentsMax = 16;

struct Opponents {
  Instant at{};  // of all states
  FixedVector<Opponent, kOpponentsMax> cars;
};

}  // namespace pitwall::world
