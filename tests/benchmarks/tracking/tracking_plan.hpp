// Scenes of the tracking benchmark. They and the noise in them (hil/sensors) were fixed before a
// tracker was run on them.
//
//   race   an hour of LVMS: six opponents pass us and are passed, change lanes, brake with 5 m/s^2
//   pair   two cars side by side, centres 3 m apart, 60 s, between 10 and 60 m ahead of us
//   blind  one car; every 10 s all sensors see nothing for 1.5 s while its speed changes with
//          up to 1 m/s^2
//
// All cars keep to lanes at a distance from the middle between the walls. The reference line of the
// map is not the middle: it swings by 8 m across the road, so a prediction along it alone is some
// metres wrong after 1.5 s.
//
//   our own car  as localization has it: errors that wander with 10 s, one sigma: 0.03 m along each
//                axis, 0.1 degrees, 0.05 m/s
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "hil/sensors/detection_params.hpp"
#include "protocol/vocabulary/time.hpp"
#include "tests/benchmarks/tracking/race_traffic.hpp"
#include "vehicle/world/track_map.hpp"

namespace pitwall::tracking_bench {

struct OwnError {
  double position_sigma_m = 0.03, yaw_sigma_rad = from_deg(0.1), speed_sigma_mps = 0.05;
  double correlation_s = 10.0;
};

struct Scene {
  std::string name;
  Duration span{};
  TrafficPlan traffic{};
  sensors::DetectionSensors sensors = sensors::av21_detection_sensors();
  OwnError own{};
  Duration blind_every{}, blind_for{};  // all sensors; zero: never
  std::uint64_t seed = 1;
};

Scene race_scene();
Scene pair_scene();
Scene blind_scene();

// The track of all scenes, from the shipped file. Throws where that cannot be read.
const world::TrackMap& las_vegas();

}  // namespace pitwall::tracking_bench
