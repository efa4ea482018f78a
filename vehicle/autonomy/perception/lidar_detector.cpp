// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/perception/lidar_detector.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace pitwall::perception {
namespace {

bool is_known(const world::EgoState& ego, Instant at) {
  const Duration age = at - ego.at;
  const Duration oldest = LidarDetector::kEgoOldest;
  return (ego.validity == world::Validity::kGood ||
          ego.validity == world::Validity::kDeadReckoning) &&
         age <= oldest && age >= -oldest;
}

// Where Body is at the reference time.
BodyPose pose_at(const world::EgoState& ego, Instant at, double over_road_m) {
  const double later_s = (at - ego.at).seconds();
  const double yaw_rad = ego.yaw_rad + later_s * ego.yaw_rate_rad_per_s;
  const double middle_rad = 0.5 * (ego.yaw_rad + yaw_rad);
  const double c = std::cos(middle_rad), s = std::sin(middle_rad);
  return {.x_m = ego.x_m + later_s * (ego.vx_mps * c - ego.vy_mps * s),
          .y_m = ego.y_m + later_s * (ego.vx_mps * s + ego.vy_mps * c),
          .yaw_rad = yaw_rad,
          .over_road_m = over_road_m};
}

world::Detection detection_of(const CarBox& car) {
  world::Detection detection;
  detection.confidence = car.confidence;
  detection.x_m = car.x_m, detection.y_m = car.y_m, detection.yaw_rad = car.yaw_rad;
  detection.length_m = car.length_m, detection.width_m = car.width_m;
  return detection;
}

}  // namespace

world::DetectionFrame LidarDetector::detect(std::span<const LidarSweep> sweeps,
                                            const world::EgoState& ego, Instant at) {
  cloud_.clear();
  const bool known = is_known(ego, at);
  const BodyMotion motion =
      known ? BodyMotion{ego.vx_mps, ego.vy_mps, ego.yaw_rate_rad_per_s} : BodyMotion{};
  for (const LidarSweep& sweep : sweeps) append_in_body(sweep, motion, cloud_);
  std::optional<TrackGround> ground;
  if (known) ground = TrackGround::fit(grid_, pose_at(ego, at, params_.origin_over_road_m), cloud_);
  ++(ground ? counts_.on_map : counts_.by_cloth);
  world::DetectionFrame frame{.source = world::DetectionSource::kLidar, .at = at};
  for (const CarBox& car : find(ground, ego.vx_mps))
    if (!frame.detections.push(detection_of(car))) ++counts_.no_room;
  return frame;
}

std::vector<CarBox> LidarDetector::find(const std::optional<TrackGround>& ground,
                                        double others_mps) {
  if (ground && network_) {
    counts_.not_finite +=
        static_cast<std::size_t>(std::ranges::count_if(cloud_, std::not_fn(is_finite)));
    return network_->detect(cloud_, *ground, others_mps);
  }
  ClusterResult found = ground ? detect_clusters(cloud_, *ground, others_mps, params_.clusters)
                               : detect_clusters(cloud_, params_.clusters);
  counts_.not_finite += found.not_finite;
  return std::move(found.cars);
}

}  // namespace pitwall::perception
