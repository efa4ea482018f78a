// LiDARs of a car in a lockstep run, ray by ray, with the car's own detector behind them: in place
// of the model of both (hil/sensors/detections.hpp).
//   in     the true cars; what the car knows of itself
//   out    a frame of detections for each sweep, kByNetwork or kByClusters after it began
//   law    a sweep is taken at the first call at or after its time; all LiDARs sweep together. What
//          moves goes on as at the sweep's begin, until its end
//   cost   0.1 s a sweep of three: a run takes two to three times as long as it lasts
//   limit  our own body hides nothing; no dust
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

#include "hil/faults/perception_faults.hpp"
#include "hil/plant/car_pose.hpp"
#include "hil/plant/plant.hpp"
#include "hil/sensors/detections.hpp"
#include "hil/sensors/lidar/lidar.hpp"
#include "hil/sensors/noise.hpp"
#include "vehicle/autonomy/perception/lidar_detector.hpp"

namespace pitwall::bench {

// As the car's detector takes them.
perception::SensorPose pose_of(const sensors::SensorMount& mount);
perception::PointCloud points_of(std::span<const sensors::LidarReturn> returns);

class SweptLidars {
 public:
  static constexpr Duration kPeriod = milliseconds(50);
  // The sweep itself takes 50 ms; then come transport and the detector.
  static constexpr Duration kByNetwork = milliseconds(100), kByClusters = milliseconds(75);

  // `track` outlives it. Without a network the detector looks for clusters.
  SweptLidars(const world::TrackMap& track, std::size_t others, std::uint64_t seed,
              std::optional<perception::PillarDetector> network = std::nullopt);

  // Appends the frames that are due.
  void step(const plant::Truth& ours, std::span<const plant::CarPose> others,
            const world::EgoState& ego, const faults::LidarFault& fault, Instant now,
            sensors::Arrivals& out);
  const perception::LidarCounts& counts() const { return detector_.counts(); }

 private:
  world::DetectionFrame sweep(const plant::Truth& ours, std::span<const plant::CarPose> others,
                              const world::EgoState& ego, const faults::LidarFault& fault,
                              Instant now);

  const world::TrackMap& track_;
  Duration latency_;
  std::vector<sensors::LidarUnit> units_ = sensors::av21_lidars();
  sensors::RayScene rays_;
  sensors::Noise noise_;
  perception::LidarDetector detector_;
  Instant next_{};
  std::deque<world::DetectionFrame> under_way_;  // the oldest first
};

}  // namespace pitwall::bench
