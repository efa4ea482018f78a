// Drawn scenes for a LiDAR detector: our car on a track among others and dust, seen by its LiDARs
// once, with what is true.
//   in     track, bodies of the other cars, what is drawn how often, seed
//   out    one sweep of each LiDAR; the true boxes at the reference time, in Body, with the number
//          of returns; our place as localization would tell it
//   drawn  cars and dust as drawn_cars.hpp, decoys as decoys.hpp; errors of our pose (0.05 m,
//          0.1 deg)
//   frames Map; Body of our car at the reference time
//   law    the same seed gives the same scene
//   cost   0.2 s a scene
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "hil/sensors/lidar/car_mesh.hpp"
#include "hil/sensors/lidar/decoys.hpp"
#include "hil/sensors/lidar/drawn_cars.hpp"
#include "hil/sensors/lidar/lidar.hpp"
#include "hil/sensors/lidar/ray_scene.hpp"
#include "vehicle/world/track_map.hpp"

namespace pitwall::sensors {

inline constexpr double kReference_s = kHorizon.seconds();  // after the sweep's begin

struct TrueBox {
  double x_m = kUnset, y_m = kUnset, yaw_rad = kUnset;  // Body
  double length_m = kUnset, width_m = kUnset;
  std::size_t returns = 0;
};

struct UnitSweep {
  SensorMount mount;
  std::vector<LidarReturn> returns;
};

struct LidarScene {
  std::vector<UnitSweep> sweeps;
  std::vector<TrueBox> cars;
  double x_m = kUnset, y_m = kUnset, yaw_rad = kUnset;  // our estimate, Map
  double speed_mps = kUnset, yaw_rate_rad_per_s = kUnset;
};

struct SceneRules {
  double dust = 1.0;        // density of the clouds; 0: there are none
  double spun_share = 0.0;  // of the others
  DecoySet decoys = DecoySet::kNone;
};

// As many bodies like `shape`, other in length, width and height, in each of their parts, and in
// what they send back: what is learned of them holds for a car that was not among them.
std::vector<CarShape> bodies_like(const CarShape& shape, std::size_t count, std::uint64_t seed);

class SceneMaker {
 public:
  // `track` outlives the maker. One body for all others, or one for each of kSceneCarsMost.
  SceneMaker(const world::TrackMap& track, const std::vector<CarShape>& bodies,
             const SceneRules& rules = {});
  LidarScene make(std::uint64_t seed);

 private:
  const world::TrackMap* track_;
  std::vector<CarShape> bodies_;
  SceneRules rules_;
  RayScene rays_;
  Decoys decoys_;
};

}  // namespace pitwall::sensors
