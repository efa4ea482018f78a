// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/perception/detector_cost.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "hil/scenes/scene_cloud.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/vocabulary/text.hpp"
#include "tests/benchmarks/cost/quantiles.hpp"
#include "tests/benchmarks/cost/reference_cost.hpp"
#include "vehicle/autonomy/perception/lidar/clusters/cluster_detector.hpp"

namespace pitwall::perception_bench {
namespace {

constexpr double kClustersLimit_us = 15'000.0, kClothLimit_us = 25'000.0;
constexpr double kTrunkLimit_us = 35'000.0, kNetworkLimit_us = 47'000.0;
constexpr int kUnits = 20;

struct TimedScene {
  sensors::LidarScene scene;
  perception::PointCloud cloud, boxed;
  std::vector<float> planes;  // of the network
};

// The part of it in the paper's box, as many points as asked for.
perception::PointCloud boxed(const perception::PointCloud& cloud) {
  const perception::Crop crop;
  perception::PointCloud points;
  for (const perception::LidarPoint& p : cloud)
    if (points.size() < kClothPoints && p.x_m <= crop.ahead_m && p.x_m >= -crop.behind_m &&
        std::abs(p.y_m) <= crop.side_m)
      points.push_back(p);
  return points;
}

double median_us(std::vector<TimedScene>& scenes, const std::function<void(TimedScene&)>& stage) {
  std::vector<double> took_us;
  for (TimedScene& scene : scenes) {
    const Duration before = transport::thread_time();
    stage(scene);
    took_us.push_back(cost::microseconds_of(transport::thread_time() - before));
  }
  return benchmarks::quantiles_of(std::move(took_us)).p50_us;
}

}  // namespace

DetectorCost measure_cost(const sensors::CarShape& shape, const world::TrackMap& track,
                          std::optional<perception::PillarDetector> network, std::uint64_t seed) {
  const perception::TrackGrid grid{track};
  const perception::ClusterParams params;
  sensors::SceneMaker maker{track, {shape}};
  std::vector<TimedScene> scenes;
  DetectorCost cost{.points = std::numeric_limits<std::size_t>::max(),
                    .cloth_points = kClothPoints};
  for (std::size_t i = 0; i < kTimedScenes; ++i) {
    const sensors::LidarScene scene = maker.make(seed + i);
    perception::PointCloud cloud = scenes::merged(scene), part = boxed(cloud);
    cost.points = std::min(cost.points, cloud.size());
    cost.cloth_points = std::min(cost.cloth_points, part.size());
    scenes.push_back({scene, std::move(cloud), std::move(part), {}});
  }
  const auto ground_under = [&](const TimedScene& s) {
    return perception::TrackGround::fit(grid, scenes::pose_of(s.scene), s.cloud);
  };
  for (TimedScene& s : scenes)
    if (const auto ground = ground_under(s))
      s.planes = planes_of(pillars_of(s.cloud, *ground, s.scene.speed_mps));
  std::array<double, 6> least_us;
  least_us.fill(std::numeric_limits<double>::infinity());
  const std::array<std::function<void(TimedScene&)>, 6> stages{
      [](TimedScene& s) { s.cloud = scenes::merged(s.scene); },
      [&](TimedScene& s) { (void)ground_under(s); },
      [&](TimedScene& s) {
        const auto ground = ground_under(s);
        if (ground) (void)detect_clusters(s.cloud, *ground, s.scene.speed_mps, params);
      },
      [&](TimedScene& s) {
        (void)perception::Cloth{s.boxed, params.cloth};
      },
      [&](TimedScene& s) {
        const auto ground = ground_under(s);
        if (network && ground) (void)network->detect(s.cloud, *ground, s.scene.speed_mps);
      },
      [&](TimedScene& s) {
        if (network) (void)network->run(s.planes);
      }};
  cost::ReferenceCost reference;
  for (int block = 0; block < kCostBlocks; ++block) {
    for (std::size_t k = 0; k < stages.size(); ++k)
      least_us[k] = std::min(least_us[k], median_us(scenes, stages[k]));
    for (int unit = 0; unit < kUnits; ++unit) reference.take();
  }
  cost.merge_us = least_us[0], cost.ground_us = least_us[1];
  cost.clusters_us = least_us[2], cost.cloth_us = least_us[3];
  if (network) cost.network_us = least_us[4], cost.trunk_us = least_us[5];
  cost.unit_us = reference.unit_us();
  return cost;
}

cost::CostGates gates_of(const DetectorCost& measured) {
  cost::CostGates gates;
  gates.at_most({"clusters on the map's ground, p50", measured.clusters_us, measured.unit_us,
                 kClustersLimit_us});
  gates.at_most(
      {"cloth over 75,000 points, p50", measured.cloth_us, measured.unit_us, kClothLimit_us});
  if (std::isfinite(measured.network_us)) {
    gates.at_most({"network's trunk, p50", measured.trunk_us, measured.unit_us, kTrunkLimit_us});
    gates.at_most({"network from cloud to cars, p50", measured.network_us, measured.unit_us,
                   kNetworkLimit_us});
  }
  gates.count("75,000 points under every timed cloth", measured.cloth_points == kClothPoints);
  return gates;
}

std::string to_text(const DetectorCost& measured) {
  constexpr double kMilli = 1e-3;
  std::string text = formatted(
      "processor time of a sweep of three LiDARs, %zu points and more, p50, ms: into one cloud "
      "%.1f, the map's ground %.1f, clusters with it %.1f; cloth over %zu points %.1f\n",
      measured.points, kMilli * measured.merge_us, kMilli * measured.ground_us,
      kMilli * measured.clusters_us, measured.cloth_points, kMilli * measured.cloth_us);
  if (std::isfinite(measured.network_us))
    text += formatted("pillar network with the map's ground %.1f, its trunk %.1f\n",
                      kMilli * measured.network_us, kMilli * measured.trunk_us);
  return text;
}

}  // namespace pitwall::perception_bench
