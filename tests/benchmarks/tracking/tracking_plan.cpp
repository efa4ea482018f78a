// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/tracking/tracking_plan.hpp"

#include <stdexcept>

#include "hil/track_file/track_map_file.hpp"

namespace pitwall::tracking_bench {
Scene race_scene() {
  Scene scene{.name = "race", .span = seconds(3600)};
  scene.traffic.is_free = true;
  scene.traffic.others = {
      {.ahead_m = 5.0, .swing_m = 85.0, .period_s = 61.0, .phase_rad = 0.3, .lane_m = kLanes_m[0]},
      {.ahead_m = -5.0, .swing_m = 75.0, .period_s = 53.0, .phase_rad = 1.5, .lane_m = kLanes_m[2]},
      {.ahead_m = 0.0, .swing_m = 60.0, .period_s = 71.0, .phase_rad = 2.7, .lane_m = kLanes_m[3]},
      {.ahead_m = 10.0, .swing_m = 45.0, .period_s = 43.0, .phase_rad = 3.6, .lane_m = kLanes_m[0]},
      {.ahead_m = 20.0, .swing_m = 30.0, .period_s = 37.0, .phase_rad = 4.9, .lane_m = kLanes_m[2]},
      {.ahead_m = -10.0,
       .swing_m = 80.0,
       .period_s = 83.0,
       .phase_rad = 5.8,
       .lane_m = kLanes_m[1]}};
  return scene;
}

Scene pair_scene() {
  Scene scene{.name = "pair", .span = seconds(63)};  // the first 3 s are not scored
  const Aim left{.ahead_m = 35.0, .swing_m = 25.0, .period_s = 30.0, .lane_m = 1.5};
  Aim right = left;
  right.lane_m = -1.5;
  scene.traffic.others = {left, right};
  scene.traffic.our_lane_m = 0.0;
  return scene;
}

Scene blind_scene() {
  Scene scene{.name = "blind", .span = seconds(600)};
  scene.traffic.others = {{.ahead_m = 25.0, .swing_m = 10.0, .period_s = 40.0, .lane_m = 1.75}};
  scene.traffic.accel_most_mps2 = scene.traffic.brake_most_mps2 = 1.0;
  scene.blind_every = seconds(10), scene.blind_for = milliseconds(1500);
  return scene;
}

const world::TrackMap& las_vegas() {
  static const world::TrackMap map = [] {
    auto built = track_file::read_track_map(std::string(PITWALL_SOURCE_DIR) +
                                            "/vehicle/config/tracks/lvms.yaml");
    if (!built) throw std::runtime_error(to_string(built.error()));
    return *std::move(built);
  }();
  return map;
}

}  // namespace pitwall::tracking_bench
