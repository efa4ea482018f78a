// Our car and one other on the stadium, both exactly where they shall be: no dynamics, no noise but
// what a test adds.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

#include "tests/vehicle/autonomy/planning/stadium.hpp"
#include "vehicle/autonomy/planning/planning.hpp"

namespace pitwall::planning::testing {

inline PassParams pass_params() {
  return {.rival = {.watch_ahead_m = 150.0, .watch_behind_m = 80.0, .forget_s = 3.0},
          .trail_gap_m = 25.0,
          .complete_gap_m = 33.0,
          .side_gap_m = 6.0,
          .side_clear_m = 3.5,
          .trail_gain_per_s = 0.25,
          .close_extra_mps = 4.0,
          .pass_extra_mps = 8.0,
          .brake_mps2 = 4.0,
          .merge_time_s = 3.5,
          .dwell_s = 0.5};
}

struct RaceRig {
  explicit RaceRig(PassLaw law = PassLaw::kCommitted) {
    params.line.offset_m = 3.0;  // inside: the stadium turns left
    params.racing = {.accel_max_mps2 = 6.0, .decel_max_mps2 = 8.0, .jerk_max_mps3 = 12.0};
    params.line.speed_max_mps = 75.0;
    params.passing = Passing{.pass = pass_params(), .lines = {{.name = {}, .offset_m = -3.0}}};
    params.passing->pass.law = law;
    own = prepare(params, track).value();
    others = prepare_others(params, track).value();
  }

  const Line& line_in_use() const { return state.line == 0 ? own : others[state.line - 1]; }
  double gap_m() const { return std::remainder(s_m - other_s_m, track.length_m()); }
  double beside_m() const { return std::abs(n_m - other_n_m); }

  world::Opponents seen() const {
    world::Opponents out;
    const world::TrackPoint p = track.offset(other_s_m + gap_noise_m, other_n_m);
    world::Opponent car;
    car.id = 1;
    car.x_m = p.x_m, car.y_m = p.y_m,
    car.yaw_rad = p.yaw_rad + other_drift_mps / std::max(other_mps, 1.0);
    car.speed_mps = other_mps;
    car.s_m = track.wrap_station(other_s_m + gap_noise_m), car.n_m = other_n_m;
    car.covariance[0] = car.covariance[5] = 0.01;
    car.measured_at = now;
    out.at = now;
    if (other_is_seen) CHECK(out.cars.push(car));
    return out;
  }

  Output tick(world::TrackFlag flag, world::VehicleFlag role, double round_mps) {
    world::RaceControl rc = green(round_mps);
    rc.track = flag, rc.vehicle = role;
    const world::TrackPoint at = track.offset(s_m, n_m);
    world::EgoState ego = ego_on(own, 0.0, 0.0, speed_mps);
    ego.x_m = at.x_m, ego.y_m = at.y_m, ego.yaw_rad = at.yaw_rad;
    const world::Opponents cars = seen();
    const Output out = step(params, own, track, state,
                            {.ego = ego,
                             .race_control = rc,
                             .operator_speed_limit_mps = operator_limit_mps,
                             .followed = Followed::kDrive,
                             .fuel = fuel,
                             .tyre_c = 85.0,
                             .other_lines = others,
                             .cars = &cars},
                            now);
    state = out.next;
    now += milliseconds(50);
    speed_mps = state.speed_mps;
    other_s_m += other_mps * 0.05;
    other_n_m += other_drift_mps * 0.05;
    // Along the planned path.
    const LinePosition p = line_in_use().project(ego.x_m, ego.y_m, state.line_s_m);
    const double next_m = p.s_m + speed_mps * 0.05;
    const Beside next =
        beside(line_in_use().at(next_m), offset_at(line_in_use(), state.merge, next_m));
    const world::Curvilinear place = track.project(next.x_m, next.y_m, s_m);
    s_m = place.s_m, n_m = place.n_m;
    return out;
  }

  Params params = recommended();
  world::TrackMap track = stadium();
  Line own;
  std::vector<Line> others;
  State state;
  Instant now{};
  double s_m = 100.0, n_m = 3.0, speed_mps = 30.0;
  double other_s_m = 220.0, other_n_m = 3.0, other_mps = 36.0, other_drift_mps = 0.0;
  double gap_noise_m = 0.0, operator_limit_mps = kUnset;
  bool other_is_seen = true;
  rules::FuelState fuel = rules::FuelState::kUnknown;
};

}  // namespace pitwall::planning::testing
