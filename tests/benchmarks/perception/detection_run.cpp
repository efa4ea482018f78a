// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/perception/detection_run.hpp"

#include "hil/scenes/scene_cloud.hpp"
#include "vehicle/autonomy/perception/lidar/clusters/cluster_detector.hpp"

namespace pitwall::perception_bench {

std::vector<SceneSet> scene_sets(std::size_t scenes, std::uint64_t seed) {
  const SceneSet held_back{"held back: SF23 at IMS, dust x 2",
                           "vehicle/config/tracks/ims.yaml",
                           sensors::sf23_shape(),
                           {.dust = 2.0},
                           scenes,
                           seed};
  SceneSet among_decoys = held_back;
  among_decoys.name += ", decoys";
  among_decoys.rules.decoys = sensors::DecoySet::kRare;
  return {held_back,
          {"known: AV-21 at LVMS, dust",
           "vehicle/config/tracks/lvms.yaml",
           sensors::av21_shape(),
           {},
           scenes,
           seed},
          among_decoys};
}

std::vector<DetectorRow> detect_scenes(const SceneSet& set, const world::TrackMap& track,
                                       std::optional<perception::PillarDetector> network) {
  const perception::TrackGrid grid{track};
  const perception::ClusterParams params;
  sensors::SceneMaker maker{track, {set.shape}, set.rules};
  DetectorRow by_network{set.name, "pillar network", {}},
      on_map{set.name, "clusters on the map", {}}, by_cloth{set.name, "clusters, cloth", {}};
  for (std::size_t i = 0; i < set.scenes; ++i) {
    const sensors::LidarScene scene = maker.make(set.seed + i);
    const perception::PointCloud cloud = scenes::merged(scene);
    score(scene.cars, detect_clusters(cloud, params).cars, by_cloth.score);
    const auto ground = perception::TrackGround::fit(grid, scenes::pose_of(scene), cloud);
    if (!ground) continue;
    score(scene.cars, detect_clusters(cloud, *ground, scene.speed_mps, params).cars, on_map.score);
    if (network)
      score(scene.cars, network->detect(cloud, *ground, scene.speed_mps), by_network.score);
  }
  if (!network) return {on_map, by_cloth};
  return {by_network, on_map, by_cloth};
}

}  // namespace pitwall::perception_bench
