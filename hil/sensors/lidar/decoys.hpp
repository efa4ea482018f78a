// Things that stand on a track and are no cars, for drawn scenes: a detector has to tell them from
// cars.
//   kinds  common: traffic cone, marshal, stack of tyres, marker board, lost wing, barrier. Rare,
//          for scenes that are held back: barrel, straw bale, quad bike with its rider
//   drawn  each kind stands once with the probability kDecoyShare, in any direction, between 60 m
//          behind and 125 m ahead of our car, from wall to wall, 4 m or more from any car; common
//          ones 0.6 to 1.5 times their size in length, width and height, so that a hundred forms of
//          each are seen
//   frames Map
//   law    the same seed gives the same decoys; cars and dust are the same with and without them
//   source sizes: cone EN 13422 (0.75 m); the others are usual ones, to 0.1 m
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "hil/sensors/lidar/car_mesh.hpp"
#include "hil/sensors/lidar/drawn_cars.hpp"
#include "hil/sensors/lidar/ray_scene.hpp"
#include "vehicle/world/track_map.hpp"

namespace pitwall::sensors {

enum class DecoySet : std::uint8_t { kNone, kCommon, kRare };

inline constexpr double kDecoyShare = 0.4;

// Made of blocks, as cars are, without wheels.
std::vector<CarShape> decoy_shapes(DecoySet set);

class Decoys {
 public:
  // Adds them to the scene, out of sight; their numbers there follow those of the cars.
  Decoys(DecoySet set, RayScene& rays);

  // Takes effect at the scene's next commit().
  void place_drawn(const world::TrackMap& track, const DrawnCars& cars, std::uint64_t seed,
                   RayScene& rays) const;

 private:
  DecoySet set_;
  std::vector<std::size_t> numbers_;  // in the scene of rays, by kind
};

}  // namespace pitwall::sensors
