// Oval of two straights and two turns of 200 m radius, with a line that swings around its
// reference line: offset, slope and speed of the line are known at every station.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "vehicle/world/raceline.hpp"
#include "vehicle/world/track_map.hpp"

namespace pitwall::traffic {

inline constexpr double kRadius_m = 200.0, kStraight_m = 400.0, kRamp_m = 100.0;
inline constexpr double kArc_m = std::numbers::pi * kRadius_m - kRamp_m;
inline constexpr double kHalf_m = kStraight_m + 2.0 * kRamp_m + kArc_m;
inline constexpr double kWall_m = 8.0;  // from the reference line, on both sides

inline const world::TrackMap& oval() {
  static const world::TrackMap track = [] {
    world::TrackDescription d{.name = "oval",
                              .length_m = 2.0 * kHalf_m,
                              .datum_latitude_deg = 0.0,
                              .datum_longitude_deg = 0.0,
                              .datum_height_m = 0.0,
                              .knots = {},
                              .pit = {},
                              .source = "oval.yaml"};
    for (const double from_m : {0.0, kHalf_m})
      for (const auto& [s_m, k] : {std::pair{0.0, 0.0},
                                   {kStraight_m, 0.0},
                                   {kStraight_m + kRamp_m, 1.0 / kRadius_m},
                                   {kStraight_m + kRamp_m + kArc_m, 1.0 / kRadius_m}})
        d.knots.push_back({from_m + s_m, k, 0.1, kWall_m, kWall_m});
    auto built = world::TrackMap::build(d);
    if (!built) ADD_FAILURE() << to_string(built.error());
    return *std::move(built);
  }();
  return track;
}

inline constexpr double kSwing_m = 2.0;
inline double swing_per_m() { return 4.0 * std::numbers::pi / kHalf_m; }
inline double swing_n_m(double s_m) { return kSwing_m * std::sin(swing_per_m() * s_m); }
inline double swing_slope(double s_m) {
  return kSwing_m * swing_per_m() * std::cos(swing_per_m() * s_m);
}
inline double swing_mps(double s_m) { return 50.0 + 8.0 * std::sin(swing_per_m() * s_m); }

// The swinging line and one through the pit lane; the first point is at station 700.
inline const world::RacelineBank& bank() {
  static const world::RacelineBank made = [] {
    world::Raceline line{.name = "swing", .region = world::Region::kTrack, .points = {}};
    for (double way_m = 0.0; way_m < 2.0 * kHalf_m - 0.5; way_m += 1.0) {
      const double s_m = oval().wrap_station(700.0 + way_m);
      const world::TrackPoint road = oval().offset(s_m, swing_n_m(s_m));
      const double turn_rad =
          std::atan2(swing_slope(s_m), 1.0 - road.curvature_per_m * swing_n_m(s_m));
      line.points.push_back({road.x_m, road.y_m, wrap_pi(road.yaw_rad + turn_rad), 0.0, 0.1});
      line.lap.push_back({.speed_mps = swing_mps(s_m)});
    }
    world::Raceline plain = line;
    plain.name = "plain";
    plain.lap.clear();
    world::Raceline pit = line;
    pit.name = "pit", pit.region = world::Region::kPitLane;
    return world::RacelineBank{.track = "oval",
                               .track_fingerprint = "",
                               .lines = {line, plain, pit},
                               .source = "oval.json"};
  }();
  return made;
}

}  // namespace pitwall::traffic
