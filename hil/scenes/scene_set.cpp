// SPDX-License-Identifier: Apache-2.0
#include "hil/scenes/scene_set.hpp"

#include <algorithm>

#include "hil/sensors/lidar/car_mesh.hpp"
#include "hil/sweep/in_parallel.hpp"

namespace pitwall::scenes {

std::vector<sensors::CarShape> bodies_of(Bodies bodies, std::uint64_t seed) {
  switch (bodies) {
    case Bodies::kAv21:
      return {sensors::av21_shape()};
    case Bodies::kSf23:
      return {sensors::sf23_shape()};
    case Bodies::kDrawn:
      break;
  }
  return sensors::bodies_like(sensors::av21_shape(), sensors::kSceneCarsMost, seed);
}

std::vector<PillarScene> make_scenes(const SceneSet& set, const world::TrackMap& track,
                                     unsigned at_a_time) {
  const perception::TrackGrid grid{track};
  std::vector<PillarScene> scenes(set.scenes);
  const std::size_t blocks = (set.scenes + kScenesOfBodies - 1) / kScenesOfBodies;
  sweep::in_parallel(blocks, at_a_time, [&](std::size_t block) {
    const std::size_t first = block * kScenesOfBodies;
    sensors::SceneMaker maker{track, bodies_of(set.bodies, set.seed + first), set.rules};
    for (std::size_t i = first; i < std::min(set.scenes, first + kScenesOfBodies); ++i)
      scenes[i] = pillar_scene(maker.make(set.seed + i), grid);
  });
  return scenes;
}

}  // namespace pitwall::scenes
