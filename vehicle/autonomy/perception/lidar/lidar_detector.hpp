// Cars that our LiDARs see: from sweeps, as they come from the sensors, to a frame of detections.
//   in     sweeps of any number of sensors; EgoState, at most kEgoOldest from the reference time
//   out    one frame in Body at the reference time, nearest cars first. Known where we are on the
//          track, the map is the ground; else a cloth
//   law    no sensor is waited for: a frame is made of the sweeps that are there
//   errors counts()
//   cost   10 ms for three LiDARs; allocates
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include "vehicle/autonomy/perception/lidar/cluster_detector.hpp"
#include "vehicle/autonomy/perception/lidar/motion.hpp"
#include "vehicle/autonomy/perception/lidar/track_grid.hpp"
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

  explicit LidarDetector(const world::TrackMap& track, const LidarParams& params = {})
      : grid_(track), params_(params) {}
  world::DetectionFrame detect(std::span<const LidarSweep> sweeps, const world::EgoState& ego,
                               Instant at);
  const LidarCounts& counts() const { return counts_; }

 private:
  TrackGrid grid_;
  LidarParams params_;
  LidarCounts counts_;
  PointCloud cloud_;
};

}  // namespace pitwall::perception
