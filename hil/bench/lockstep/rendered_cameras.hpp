// The front cameras of a car in a lockstep run: images of what rays meet, with the car's own
// detector behind them, in place of the model of both (hil/sensors/detections.hpp).
//   in     the true cars
//   out    a frame of detections for each image, kLatency after it was taken
//   law    an image is taken at the first call at or after its time, the two cameras in turn, each
//          every kPeriod. Every run has the same daylight
//   cost   0.12 s an image: a run takes two to three times as long as it lasts
//   limit  those of hil/sensors/camera/camera.hpp; no dust
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "hil/faults/perception_faults.hpp"
#include "hil/plant/car_pose.hpp"
#include "hil/plant/plant.hpp"
#include "hil/sensors/camera/camera.hpp"
#include "hil/sensors/detections.hpp"
#include "hil/sensors/noise.hpp"
#include "vehicle/autonomy/perception/camera/camera_detector.hpp"

namespace pitwall::bench {

// As the car's sensor file would have it.
perception::CameraMounting mounting_of(const sensors::CameraUnit& unit);

class RenderedCameras {
 public:
  static constexpr Duration kPeriod = milliseconds(100);
  // Exposure and transport, then the detector at its low priority.
  static constexpr Duration kLatency = milliseconds(100);

  // `track` outlives it.
  RenderedCameras(const world::TrackMap& track, std::size_t others, std::uint64_t seed,
                  perception::CameraDetector detector);

  // Appends the frames that are due.
  void step(const plant::Truth& ours, std::span<const plant::CarPose> others,
            const faults::CameraFault& fault, Instant now, sensors::Arrivals& out);
  const perception::CameraCounts& counts() const { return detector_.counts(); }

 private:
  void expose(std::size_t unit, const plant::Truth& ours, std::span<const plant::CarPose> others,
              Instant now);

  const world::TrackMap& track_;
  std::vector<sensors::CameraUnit> units_ = sensors::av21_front_cameras();
  sensors::RayScene rays_;
  sensors::Look look_ = sensors::daylight();
  sensors::Noise noise_;
  perception::CameraDetector detector_;
  std::vector<Instant> next_;                    // by unit
  std::deque<world::DetectionFrame> under_way_;  // the oldest first
};

}  // namespace pitwall::bench
