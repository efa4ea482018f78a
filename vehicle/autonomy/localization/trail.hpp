// History of the filter's predictions, one per tick: a late sample is compared with the prediction
// for its own time, which the filter made without it.
//   in     one Estimate per tick
//   out    prediction for an antenna at a lever arm at an instant within the last kTrailTicks
//   frames Map and Body as in measurement.hpp
//   invariants
//          nullopt before the first tick and for an instant older than the history; after the
//          newest tick the motion is extrapolated, for at most kAhead
//   cost   O(kTrailTicks); no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <type_traits>

#include "protocol/vocabulary/time.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/autonomy/localization/filter/filter.hpp"

namespace pitwall::localization {

inline constexpr std::size_t kTrailTicks = 64;  // 0.64 s: above window_s of the car file

// Motion of the car at one instant. Angles and heights that a planar filter does not estimate are
// those of the road.
struct Moment {
  Instant at{};
  double x_m = kUnset, y_m = kUnset, z_m = kUnset;  // centre of gravity, Map
  double yaw_rad = kUnset, pitch_rad = 0.0, roll_rad = 0.0;
  std::array<double, 3> velocity_mps{};    // Map
  std::array<double, 3> rate_rad_per_s{};  // Body
  double speed_mps = 0.0;                  // over ground
  double position_sigma_m = kUnset, yaw_sigma_rad = kUnset, speed_sigma_mps = kUnset;

  struct Vector {
    double x, y, z;
  };
  Vector arm_m(const LeverArm& arm) const;         // lever arm in Map
  Vector antenna_mps(const LeverArm& arm) const;   // Map
  double azimuth_rad(double direction_rad) const;  // Map; of a direction in Body
  double course_rad() const;                       // of the centre of gravity, in Map
};

struct Trail {
  std::array<Moment, kTrailTicks> moments{};
  std::size_t size = 0, next = 0;

  static constexpr Duration kAhead = milliseconds(50);

  void note(const Estimate& estimate, const Road& road);
  std::optional<Moment> at(Instant instant) const;
  const Moment* newest() const;  // null before the first
};
static_assert(std::is_trivially_copyable_v<Trail>);

}  // namespace pitwall::localization
