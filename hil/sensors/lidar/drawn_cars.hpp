// Drawn traffic for scenes of LiDARs and cameras: our car on a track among others and dust.
//   drawn  up to five others from 100 m behind to 125 m ahead, no two in one place, within 15 m/s
//          of our speed and 6 deg of the road's direction, but for those that have spun: at rest in
//          any direction; behind every third a trail of dust; some dust of no car; our springs
//          (pitch and roll 0.4 deg)
//   frames Map
//   law    the same noise gives the same cars
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "hil/sensors/lidar/car_mesh.hpp"
#include "hil/sensors/lidar/lidar.hpp"
#include "hil/sensors/lidar/ray_scene.hpp"
#include "hil/sensors/noise.hpp"
#include "protocol/vocabulary/units.hpp"
#include "vehicle/world/track_map.hpp"

namespace pitwall::sensors {

inline constexpr double kOriginOverRoad_m = 0.3;  // of Body, without springs
inline constexpr std::size_t kSceneCarsMost = 5;  // others

struct OnTrack {
  double s_m = kUnset, n_m = kUnset, speed_mps = kUnset, turned_rad = kUnset;
};

// As motion_on_road().
BodyMotion motion_on_track(const world::TrackMap& track, const OnTrack& car, double over_m = 0.0);

struct DrawnCars {
  OnTrack ours;
  std::vector<BodyMotion> others;  // as Vehicle (mesh.hpp)
};

// `spun_share`: of the others.
DrawnCars draw_cars(const world::TrackMap& track, double spun_share, Noise& noise);

std::vector<DustCloud> draw_dust(const world::TrackMap& track, const DrawnCars& cars,
                                 double density, Noise& noise);

// Bodies of a scene's others: one for all, or one for each.
inline const CarShape& shape_of(std::span<const CarShape> bodies, std::size_t car) {
  return bodies[car % bodies.size()];
}

// What stands still, and kSceneCarsMost cars: their numbers are 0, 1, ... No body is a CHECK.
RayScene scene_with_cars(std::span<const Mesh> still, std::span<const CarShape> bodies);

// Our Body on its springs.
BodyMotion sprung_body(const world::TrackMap& track, const OnTrack& ours, Noise& noise);

inline double between(Noise& noise, double least, double most) {
  return least + (most - least) * noise.uniform();
}

}  // namespace pitwall::sensors
