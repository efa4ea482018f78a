// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/perception/detection_run.hpp"

#include "hil/bench/lockstep/swept_lidars.hpp"
#include "protocol/transport/file.hpp"
#include "vehicle/autonomy/perception/lidar/motion.hpp"
#include "vehicle/parameters/track_file.hpp"

namespace pitwall::perception_bench {

perception::PointCloud merged(const sensors::LidarScene& scene) {
  perception::PointCloud cloud;
  for (const sensors::UnitSweep& sweep : scene.sweeps)
    append_in_body(
        {bench::pose_of(sweep.mount), bench::points_of(sweep.returns), -sensors::kReference_s},
        {scene.speed_mps, 0.0, scene.yaw_rate_rad_per_s}, cloud);
  return cloud;
}

perception::BodyPose pose_of(const sensors::LidarScene& scene) {
  return {scene.x_m, scene.y_m, scene.yaw_rad, sensors::kOriginOverRoad_m};
}

Result<world::TrackMap, Problem> read_map(const std::string& track_file) {
  const auto text = transport::read_file(track_file);
  if (!text) return Unexpected{text.error()};
  const auto description = parameters::read_track(*text, track_file);
  if (!description) return Unexpected{description.error()};
  return world::TrackMap::build(*description);
}

std::vector<DetectorRow> detect_scenes(const SceneSet& set, const world::TrackMap& track) {
  const perception::TrackGrid grid{track};
  const perception::ClusterParams params;
  sensors::SceneMaker maker{track, set.shape, set.dust};
  DetectorRow on_map{set.name, "clusters on the map", {}},
      by_cloth{set.name, "clusters, cloth", {}};
  for (std::size_t i = 0; i < set.scenes; ++i) {
    const sensors::LidarScene scene = maker.make(set.seed + i);
    const perception::PointCloud cloud = merged(scene);
    score(scene.cars, detect_clusters(cloud, params).cars, by_cloth.score);
    const auto ground = perception::TrackGround::fit(grid, pose_of(scene), cloud);
    if (ground)
      score(scene.cars, detect_clusters(cloud, *ground, scene.speed_mps, params).cars,
            on_map.score);
  }
  return {on_map, by_cloth};
}

}  // namespace pitwall::perception_bench
