// Processor time of the stages of LiDAR detection.
//   in     drawn scenes
//   out    p50 over kTimedScenes of each stage, the least of kCostBlocks passes: sweeps into one
//          cloud, the map's ground under it, clusters on it, the network on it; beside them the
//          cloth over the first kClothPoints points of the paper's box
//   units  processor time of the calling thread
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "hil/sensors/lidar/random_scene.hpp"
#include "tests/benchmarks/cost/cost_gates.hpp"
#include "vehicle/autonomy/perception/lidar/pillars/pillar_detector.hpp"
#include "vehicle/world/track_map.hpp"

namespace pitwall::perception_bench {

inline constexpr int kCostBlocks = 5;
inline constexpr std::size_t kTimedScenes = 10, kClothPoints = 75'000;

struct DetectorCost {
  double merge_us = 0.0, ground_us = 0.0, clusters_us = 0.0, cloth_us = 0.0;
  double network_us = kUnset, trunk_us = kUnset;  // unset without a network
  std::size_t points = 0, cloth_points = 0;       // the fewest of a cloud
  double unit_us = 0.0;
};

DetectorCost measure_cost(const sensors::CarShape& shape, const world::TrackMap& track,
                          std::optional<perception::PillarDetector> network, std::uint64_t seed);

// On the reference machine: clusters with their ground 15 ms, the cloth 25 ms; the network's trunk
// 35 ms, with all before and after it 47 ms.
cost::CostGates gates_of(const DetectorCost& measured);

std::string to_text(const DetectorCost& measured);

}  // namespace pitwall::perception_bench
