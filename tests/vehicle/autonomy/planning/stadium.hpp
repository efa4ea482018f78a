// Stadium track for the tests of planning: two straights and two banked turns, and the recommended
// parameters of the AV-21.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <numbers>
#include <optional>

#include "tests/vehicle/envelope/car.hpp"
#include "vehicle/autonomy/planning/planning.hpp"

namespace pitwall::planning::testing {

// Turns of the given radius joined to 400 m straights by 100 m of linearly changing curvature.
inline world::TrackMap stadium(double radius_m = 200.0,
                               std::optional<world::PitLane> pit = std::nullopt) {
  constexpr double kStraight_m = 400.0, kJoin_m = 100.0;
  const double arc_m = std::numbers::pi * radius_m - kJoin_m, k = 1.0 / radius_m;
  const double half_m = kStraight_m + 2.0 * kJoin_m + arc_m;
  world::TrackDescription d;
  d.name = "stadium";
  d.pit = pit;
  d.length_m = 2.0 * half_m;
  d.datum_latitude_deg = 36.27, d.datum_longitude_deg = -115.01, d.datum_height_m = 594.0;
  for (const double from : {0.0, half_m}) {
    const auto knot = [&](double s, double curvature, double bank_deg) {
      d.knots.push_back({from + s, curvature, from_deg(bank_deg), 8.0, 8.0});
    };
    knot(0.0, 0.0, 6.0);
    knot(kStraight_m, 0.0, 6.0);
    knot(kStraight_m + kJoin_m, k, 20.0);
    knot(kStraight_m + kJoin_m + arc_m, k, 20.0);
  }
  auto map = world::TrackMap::build(d);
  CHECK(map.has_value());
  return *std::move(map);
}

inline Params recommended() {
  Params p;
  p.line = {.offset_m = 0.0,
            .wall_clearance_m = 1.5,
            .spacing_m = 2.0,
            .speed_max_mps = 68.0,
            .grip_share = 0.8,
            .friction = envelope::testing::av21()};
  p.green_speed_mps = 40.0, p.caution_speed_mps = 22.0;
  p.comfort = {.accel_max_mps2 = 2.5, .decel_max_mps2 = 3.0, .jerk_max_mps3 = 5.0};
  p.racing = p.comfort;
  p.speed_band_mps = 4.0;
  p.stop_decel_max_mps2 = 5.0, p.stop_jerk_max_mps3 = 8.0, p.stop_grip_share = 0.7;
  p.stop_friction = 1.0;
  p.stop_path = {.clearance_m = 2.5, .low_speed_mps = 20.0, .stretch_max = 1.5};
  p.emergency_decel_max_mps2 = 8.0, p.emergency_jerk_max_mps3 = 15.0;
  p.emergency_grip_share = 0.85;
  p.point_spacing_m = 2.5;
  p.steer_share = 0.9;
  p.merge_from_m = 1.5, p.merge_time_s = 4.0, p.merge_least_m = 60.0;
  return p;
}
inline const Params kParams = recommended();

inline world::RaceControl green(double round_speed_mps = kUnset) {
  world::RaceControl rc;
  rc.ever_received = true;
  rc.track = world::TrackFlag::kGreen;
  rc.round_target_speed_mps = round_speed_mps;
  return rc;
}

// A car at station s of the line, offset to the left by `offset_m`, moving along it.
inline world::EgoState ego_on(const Line& line, double s_m, double offset_m, double speed_mps) {
  const LinePoint p = line.at(s_m);
  world::EgoState ego;
  ego.validity = world::Validity::kGood;
  ego.x_m = p.x_m - offset_m * std::sin(p.yaw_rad);
  ego.y_m = p.y_m + offset_m * std::cos(p.yaw_rad);
  ego.yaw_rad = p.yaw_rad;
  ego.vx_mps = speed_mps;
  ego.vy_mps = ego.yaw_rate_rad_per_s = 0.0;
  return ego;
}

}  // namespace pitwall::planning::testing
