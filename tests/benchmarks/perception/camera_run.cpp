// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/perception/camera_run.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "hil/bench/lockstep/rendered_cameras.hpp"
#include "protocol/transport/clock.hpp"
#include "tests/benchmarks/cost/quantiles.hpp"
#include "tests/benchmarks/cost/reference_cost.hpp"
#include "tests/benchmarks/perception/detector_cost.hpp"

namespace pitwall::perception_bench {
namespace {

perception::Image image_of(sensors::CameraScene& scene) {
  return {static_cast<std::size_t>(scene.image.width_px),
          static_cast<std::size_t>(scene.image.height_px), std::move(scene.image.rgb)};
}

sensors::CameraSceneMaker maker_of(const SceneSet& set, const world::TrackMap& track) {
  return {track,
          {set.shape},
          {.dust = set.rules.dust,
           .spun_share = set.rules.spun_share,
           .varied = false,
           .decoys = set.rules.decoys}};
}

}  // namespace

CameraScore look_at_images(const SceneSet& set, const world::TrackMap& track,
                           perception::CameraDetector& detector) {
  sensors::CameraSceneMaker maker = maker_of(set, track);
  CameraScore sums;
  for (std::size_t i = 0; i < set.scenes; ++i) {
    sensors::CameraScene scene = maker.make(set.seed + i);
    perception::CameraMounting camera = bench::mounting_of(scene.unit);
    camera.car_height_m = set.shape.height_m;
    const perception::Image image = image_of(scene);
    score(scene, detector.detect(image, camera, 0, Instant{}), sums);
  }
  return sums;
}

CameraCost measure_image_cost(const SceneSet& set, const world::TrackMap& track,
                              perception::CameraDetector& detector) {
  constexpr int kUnitsABlock = 20;
  sensors::CameraSceneMaker maker = maker_of(set, track);
  std::vector<perception::Image> images;
  for (std::size_t i = 0; i < kTimedImages; ++i) {
    sensors::CameraScene scene = maker.make(set.seed + i);
    images.push_back(image_of(scene));
  }
  CameraCost cost{.image_us = std::numeric_limits<double>::infinity()};
  cost::ReferenceCost reference;
  for (int block = 0; block < kCostBlocks; ++block) {
    std::vector<double> took_us;
    for (const perception::Image& image : images) {
      const Duration before = transport::thread_time();
      (void)detector.boxes_in(image);
      took_us.push_back(cost::microseconds_of(transport::thread_time() - before));
    }
    cost.image_us = std::min(cost.image_us, benchmarks::quantiles_of(std::move(took_us)).p50_us);
    for (int unit = 0; unit < kUnitsABlock; ++unit) reference.take();
  }
  cost.unit_us = reference.unit_us();
  return cost;
}

void add_gates(const CameraCost& measured, cost::CostGates& gates) {
  constexpr double kImageLimit_us = 50'000.0;
  gates.at_most(
      {"camera's network, an image, p50", measured.image_us, measured.unit_us, kImageLimit_us});
}

}  // namespace pitwall::perception_bench
