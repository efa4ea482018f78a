// Racing line: a closed path at a constant offset from the track's reference line, or a raceline of
// the track's bank, with the speeds of its fastest lap on the envelope of the car. Built at
// start-up, read-only afterwards.
//   frames Map; offset positive left; curvature positive left
//   errors build_line: the line leaves the road; a bank without the line that is named, or none
//   cost   build O(points) and the envelope; at() and project() near a hint O(1), no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/envelope/envelope_table.hpp"
#include "vehicle/envelope/friction.hpp"
#include "vehicle/world/legal_range.hpp"
#include "vehicle/world/raceline.hpp"
#include "vehicle/world/track_map.hpp"
#include "vehicle/world/tyre_grip.hpp"

namespace pitwall::planning {

struct LineParams {
  std::string bank = {}, name = {};  // file of a bank and its line; empty: a line at an offset
  double offset_m = kUnset;          // from the track's reference line; 0 with a bank
  double wall_clearance_m = kUnset;  // minimum from the centre of gravity to a wall
  double spacing_m = kUnset;         // of a line at an offset
  double speed_max_mps = kUnset;
  double grip_share = kUnset;  // usable share of the friction ellipse
  envelope::FrictionParams friction;
};

// Read only where no bank is named.
inline constexpr auto kOffsetRanges = std::to_array<world::NamedRange<LineParams>>({
    {"offset_m", &LineParams::offset_m, -30.0, 30.0},
});
inline constexpr auto kLineRanges = std::to_array<world::NamedRange<LineParams>>({
    {"wall_clearance_m", &LineParams::wall_clearance_m, 0.0, 10.0},
    {"spacing_m", &LineParams::spacing_m, 0.5, 5.0},
    {"speed_max_mps", &LineParams::speed_max_mps, 5.0, 110.0},
    {"grip_share", &LineParams::grip_share, 0.1, 1.0},
});

struct LinePoint {
  double s_m = kUnset;                      // along the line
  double track_s_m = kUnset, n_m = kUnset;  // place on the track's reference line
  double x_m = kUnset, y_m = kUnset, yaw_rad = kUnset;
  double cos_yaw = kUnset, sin_yaw = kUnset;  // set in `points`; unset in the result of at()
  double curvature_per_m = kUnset, bank_rad = kUnset;
  std::array<double, world::kTyreRows> speed_mps{};    // of the lap, by the row of the tyres
  double room_left_m = kUnset, room_right_m = kUnset;  // from the line to the walls
};

// Speed of the lap on tyres of this temperature.
inline double limit_mps(const LinePoint& p, const world::TyrePlace& tyres) {
  return world::between(p.speed_mps, tyres);
}

struct LinePosition {
  double s_m = kUnset, offset_m = kUnset;
};

inline constexpr std::size_t kLinesMost = 30;  // of a bank: what radio and console can number

struct Line {
  std::size_t number = 0;         // in its bank, from 1; 0: at an offset
  std::vector<LinePoint> points;  // equal steps of s; the first is one step after the last
  double length_m = 0.0, spacing_m = 0.0;
  std::array<double, world::kTyreRows> lap_s{};  // of its fastest lap; unset where none is possible

  double wrap(double s_m) const;
  LinePoint at(double s_m) const;  // interpolated; s is wrapped
  // Nearest point. With a hint the search stays within 50 m of it.
  LinePosition project(double x_m, double y_m, std::optional<double> hint_s_m = std::nullopt) const;
};

// `bank` is that of params.bank, for this track and checked; null if none is named.
Result<Line, Problem> build_line(
    const world::TrackMap& track, const LineParams& params,
    const world::RacelineBank* bank = nullptr,
    const std::optional<envelope::SteeringLimit>& steering = std::nullopt);

}  // namespace pitwall::planning
