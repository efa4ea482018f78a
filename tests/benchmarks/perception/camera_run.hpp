// The camera's detector on drawn images of a track, and its processor time.
//   in     track, body of the others, dust, number of images, seed; the network
//   out    score; p50 of an image, the least of kCostBlocks passes over kTimedImages
//   units  processor time of the calling thread
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tests/benchmarks/perception/camera_score.hpp"
#include "tests/benchmarks/perception/detection_run.hpp"
#include "vehicle/autonomy/perception/camera/camera_detector.hpp"

namespace pitwall::perception_bench {

inline constexpr std::size_t kTimedImages = 10;

CameraScore look_at_images(const SceneSet& set, const world::TrackMap& track,
                           perception::CameraDetector& detector);

struct CameraCost {
  double image_us = kUnset, unit_us = kUnset;
};
CameraCost measure_image_cost(const SceneSet& set, const world::TrackMap& track,
                              perception::CameraDetector& detector);

// On the reference machine at most 50 ms an image: two cameras at 10 Hz take one processor.
void add_gates(const CameraCost& measured, cost::CostGates& gates);

}  // namespace pitwall::perception_bench
