// Many drawn scenes of a track, as the pillar network sees them.
//   in     track; how the others look; rules, number of scenes, seed
//   law    the same set is the same scenes, on any number of threads; two seeds share no scene if
//          they are further apart than the number of scenes
//   cost   0.05 s a scene and processor
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "hil/scenes/pillar_scenes.hpp"
#include "hil/sensors/lidar/random_scene.hpp"
#include "vehicle/world/track_map.hpp"

namespace pitwall::scenes {

enum class Bodies : std::uint8_t {
  kAv21,
  kSf23,
  kDrawn,  // like the AV-21, others for each kScenesOfBodies scenes
};
inline constexpr std::size_t kScenesOfBodies = 50;

// One body, or one for each of the cars of a scene.
std::vector<sensors::CarShape> bodies_of(Bodies bodies, std::uint64_t seed);

struct SceneSet {
  Bodies bodies = Bodies::kAv21;
  sensors::SceneRules rules;
  std::size_t scenes = 0;
  std::uint64_t seed = 0;
};

std::vector<PillarScene> make_scenes(const SceneSet& set, const world::TrackMap& track,
                                     unsigned at_a_time);

}  // namespace pitwall::scenes
