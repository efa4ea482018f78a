// Scenes as the pillar network sees them, with what is true: for its training, and as a test of it
// that needs no bench.
//   format a folder of arrays (npy.hpp): counts (u32: pillars, cars; a row a scene), cells (u32 a
//          pillar), features (u8 each a pillar: steps of `scales`), scales (f32: least, step; a row
//          a feature), cars (f32: ahead_m, n_m, yaw_rad to the road, length_m, width_m, returns)
//   law    what is read is what was written, to half a step
//   errors Problem with the file: missing, of another shape, or cut short
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "hil/sensors/lidar/random_scene.hpp"
#include "protocol/vocabulary/result.hpp"
#include "vehicle/autonomy/perception/lidar/pillars/pillar_decoder.hpp"
#include "vehicle/autonomy/perception/lidar/pillars/pillar_grid.hpp"
#include "vehicle/autonomy/perception/lidar/track_grid.hpp"

namespace pitwall::scenes {

struct TrueCar {
  perception::RoadBox box;
  std::size_t returns = 0;
};

struct PillarScene {
  std::vector<perception::Pillar> pillars;
  std::vector<TrueCar> cars;
};

// Empty where our car takes itself to be beyond the walls.
PillarScene pillar_scene(const sensors::LidarScene& scene, const perception::TrackGrid& grid);

Result<bool, Problem> write_scenes(std::span<const PillarScene> scenes, const std::string& folder);
Result<std::vector<PillarScene>, Problem> read_scenes(const std::string& folder);

}  // namespace pitwall::scenes
