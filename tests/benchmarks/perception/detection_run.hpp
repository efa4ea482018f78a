// LiDAR detectors on drawn scenes of a track.
//   in     track, body of the others, dust, number of scenes, seed
//   out    score of each detector: the network, clusters on the map's ground, clusters that know no
//          track
//   law    each sees the same clouds
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hil/sensors/lidar/random_scene.hpp"
#include "tests/benchmarks/perception/detection_score.hpp"
#include "vehicle/autonomy/perception/lidar/pillars/pillar_detector.hpp"
#include "vehicle/world/track_map.hpp"

namespace pitwall::perception_bench {

struct SceneSet {
  std::string name, track_file;
  sensors::CarShape shape;
  sensors::SceneRules rules;
  std::size_t scenes = 0;
  std::uint64_t seed = 0;
};

// Another body and track than those of the training, and more dust; one of its kind; the first
// again, among things that are no cars.
std::vector<SceneSet> scene_sets(std::size_t scenes, std::uint64_t seed);

struct DetectorRow {
  std::string set, detector;
  DetectionScore score;
};

// `network`: without one, clusters alone.
std::vector<DetectorRow> detect_scenes(const SceneSet& set, const world::TrackMap& track,
                                       std::optional<perception::PillarDetector> network);

}  // namespace pitwall::perception_bench
