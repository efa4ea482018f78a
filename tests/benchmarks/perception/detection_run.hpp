// LiDAR detectors on drawn scenes of a track.
//   in     track, body of the others, dust, number of scenes, seed
//   out    score of each detector: clusters on the map's ground, clusters that know no track
//   law    each sees the same clouds
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hil/sensors/lidar/random_scene.hpp"
#include "protocol/vocabulary/result.hpp"

#include "tests/benchmarks/perception/detection_score.hpp"
#include "vehicle/autonomy/perception/lidar/point_cloud.hpp"
#include "vehicle/autonomy/perception/lidar/track_ground.hpp"
#include "vehicle/world/track_map.hpp"

namespace pitwall::perception_bench {

struct SceneSet {
  std::string name, track_file;
  sensors::CarShape shape;
  double dust = 1.0;
  std::size_t scenes = 0;
  std::uint64_t seed = 0;
};

struct DetectorRow {
  std::string set, detector;
  DetectionScore score;
};

// One cloud of all sweeps, in Body at the reference time.
perception::PointCloud merged(const sensors::LidarScene& scene);
perception::BodyPose pose_of(const sensors::LidarScene& scene);

Result<world::TrackMap, Problem> read_map(const std::string& track_file);
std::vector<DetectorRow> detect_scenes(const SceneSet& set, const world::TrackMap& track);

}  // namespace pitwall::perception_bench
