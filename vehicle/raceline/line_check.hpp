// Check of a raceline: whether it is a line that a car can drive around its track.
//   in     a raceline, from the builder or from a file; the lanes of its track; what the car can do
//   out    the extremes, each with the arc length where it is
//   invariants
//          refused is a line whose points are not at even steps, or whose heading or curvature is
//          not that of its points (a kink); that does not go once around the track; that crosses
//          itself; on which half the width of the car reaches over a side of its region; that needs
//          more steering than the car has; whose curvature jumps: the wheels would have to turn
//          faster than they can at the speed of the corner; whose speed profile, where it has one,
//          is refused by profile/lap_check.hpp
//   units  m, rad, s; arc lengths in m
//   errors Problem with the name of the line and the arc length; the value and what is allowed
//   cost   O(points), without crossing O(points^2 / 1024)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "protocol/vocabulary/result.hpp"
#include "vehicle/raceline/lanes/lanes.hpp"
#include "vehicle/raceline/lanes/raceline.hpp"
#include "vehicle/raceline/profile/lap_check.hpp"

namespace pitwall::raceline {

struct CarLimits {
  double width_m = kUnset;  // over the wheels
  double wheelbase_m = kUnset;
  double steer_max_rad = kUnset;             // of the road wheels
  double steer_rate_max_rad_per_s = kUnset;  // likewise
  // What the tyres carry, m/s.
  std::function<double(double curvature_per_m, double bank_rad)> corner_speed_mps;
  // Against which speed profiles are checked; without it they are not.
  const envelope::EnvelopeTable* envelope = nullptr;
};

struct LineFigures {
  std::string name;
  double length_m = kUnset;
  std::size_t points = 0;
  Extreme room_least{};       // from the side of the car to the side of the region, m
  Extreme curvature_most{};   // without sign, 1/m
  Extreme steer_rate_most{};  // of the road wheels at the speed of the corner, rad/s
  Extreme speed_least{};      // that the tyres carry, m/s
  Extreme mismatch_most{};    // between the curvature and the turn of the points, 1/m
  std::optional<LapFigures> lap;
};

Result<LineFigures, Problem> check_raceline(const Raceline& line, const Lanes& lanes,
                                            const CarLimits& car);

}  // namespace pitwall::raceline
