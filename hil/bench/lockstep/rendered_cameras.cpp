// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/lockstep/rendered_cameras.hpp"

#include <utility>

#include "hil/bench/lockstep/swept_lidars.hpp"
#include "hil/sensors/lidar/body_motion.hpp"
#include "hil/sensors/lidar/car_mesh.hpp"

namespace pitwall::bench {
namespace {

constexpr std::uint64_t kImageStream = 0xCA3E4B;

}  // namespace

perception::CameraMounting mounting_of(const sensors::CameraUnit& unit) {
  return {pose_of(unit.mount), unit.optics, sensors::av21_shape().height_m};
}

RenderedCameras::RenderedCameras(const world::TrackMap& track, std::size_t others,
                                 std::uint64_t seed, perception::CameraDetector detector)
    : track_(track),
      rays_(sensors::track_scene_meshes(track)),
      noise_(seed, kImageStream),
      detector_(std::move(detector)) {
  const std::vector<sensors::Mesh> body = sensors::car_meshes(sensors::av21_shape());
  for (std::size_t car = 0; car < others; ++car) rays_.add_car(body);
  for (std::size_t unit = 0; unit < units_.size(); ++unit)
    next_.push_back(Instant{} + static_cast<std::int64_t>(unit) * (kPeriod / 2));
}

void RenderedCameras::step(const plant::Truth& ours, std::span<const plant::CarPose> others,
                           const faults::CameraFault& fault, Instant now, sensors::Arrivals& out) {
  for (std::size_t unit = 0; unit < units_.size(); ++unit) {
    if (now < next_[unit]) continue;
    next_[unit] = now + kPeriod;
    if (!fault.outage[unit]) expose(unit, ours, others, now);
  }
  while (!under_way_.empty() && under_way_.front().received <= now && out.push(under_way_.front()))
    under_way_.pop_front();
}

void RenderedCameras::expose(std::size_t unit, const plant::Truth& ours,
                             std::span<const plant::CarPose> others, Instant now) {
  std::vector<sensors::BodyMotion> cars;
  for (const plant::CarPose& car : others) cars.push_back(sensors::motion_on_road(track_, car));
  sensors::place_cars(cars, rays_);
  sensors::CameraImage image = sensors::camera_image(
      units_[unit], rays_, {sensors::motion_of(ours), cars, {}}, look_, noise_);
  world::DetectionFrame frame =
      detector_.detect({static_cast<std::size_t>(image.width_px),
                        static_cast<std::size_t>(image.height_px), std::move(image.rgb)},
                       mounting_of(units_[unit]), static_cast<std::uint8_t>(unit), now);
  frame.received = now + kLatency;
  under_way_.push_back(frame);
}

}  // namespace pitwall::bench
