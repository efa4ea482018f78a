// Cars that our LiDARs see: from sweeps, as they come from the sensors, to a frame of detections.
//   in     sweeps of any number of sensors; EgoState, at most kEgoOldest from the reference time
//   out    one frame in Body at the reference time. Known where we are on the track, the map is the
//          ground and the network, if there is one, finds the cars; else clusters do, where we are
//          not known over a cloth
//   law    no sensor is waited for: a frame is made of the sweeps that are there
//   errors counts()
//   cost   10 ms for three LiDARs by clusters, 40 ms by the network; allocates
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "vehicle/autonomy/perception/lidar/car_box.hpp"
#include "vehicle/autonomy/perception/lidar/clusters/cluster_detector.hpp"
#include "vehicle/autonomy/perception/lidar/motion.hpp"
#include "vehicle/autonomy/perception/lidar/pillars/pillar_detector.hpp"
#include "vehicle/autonomy/perception/lidar/track_grid.hpp"
#include "vehicle/autonomy/perception/lidar/track_ground.hpp"
#include "vehicle/world/detection.hpp"
#include "vehicle/world/ego_state.hpp"

namespace pitwall::perception {

struct LidarParams {
  ClusterParams clusters;
  double origin_over_road_m = 0.3;  // of Body
};

struct LidarCounts {
  std::size_t on_map = 0, by_cloth = 0;  // frames
  std::size_t not_finite = 0;            // points
  std::size_t no_room = 0;               // detections beyond world::kDetectionsMax
};

class LidarDetector {
 public:
  static constexpr Duration kEgoOldest = milliseconds(200);

  // `track` outlives the detector.
  explicit LidarDetector(const world::TrackMap& track, const LidarParams& params = {},
                         std::optional<PillarDetector> network = std::nullopt)
      : grid_(track), params_(params), network_(std::move(network)) {}
  world::DetectionFrame detect(std::span<const LidarSweep> sweeps, const world::EgoState& ego,
                               Instant at);
  const LidarCounts& counts() const { return counts_; }
  // Of the last frame: its sweeps as one cloud, in Body.
  const PointCloud& cloud() const { return cloud_; }

 private:
  std::vector<CarBox> find(const std::optional<TrackGround>& ground, double others_mps);

  TrackGrid grid_;
  LidarParams params_;
  std::optional<PillarDetector> network_;
  LidarCounts counts_;
  PointCloud cloud_;
};

}  // namespace pitwall::perception
