// Surroundings of a track for the LiDAR model: road, walls, fence, grass.
//   in     map of the track; sizes
//   out    meshes in Map: the road as TrackMap::road() has it, ruled by the banking, from wall to
//          wall; both walls, the posts and ropes of the catch fence over the outer one; a strip of
//          grass beyond the inner wall
//   limit  the surface beyond the walls is a guess; stands, pit buildings and trees are missing
//   cost   24 quads per step of the track
//   source wall 1.1 m (SAFER barrier 40 in), fence to 6.4 m with posts each 6 m: photographs of IMS
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "hil/sensors/lidar/mesh.hpp"
#include "vehicle/world/track_map.hpp"

namespace pitwall::sensors {

struct TrackSurroundings {
  double step_m = 3.0;  // along the track
  int lanes = 8;        // quads across the road
  double wall_m = 1.1, wall_thick_m = 0.5;
  double fence_m = 6.4, post_each_m = 6.0, post_wide_m = 0.2;
  double rope_each_m = 1.0, rope_wide_m = 0.03;
  double grass_wide_m = 15.0;
};

// In this order.
enum class TrackMesh : std::uint8_t { kRoad, kWalls, kFence, kGrass };

std::vector<Mesh> track_meshes(const world::TrackMap& track,
                               const TrackSurroundings& surroundings = {});

// What LiDARs hardly see: the white lines along both walls, and the one across at station 0.
Mesh line_mesh(const world::TrackMap& track);

}  // namespace pitwall::sensors
