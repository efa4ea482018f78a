// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/lockstep/swept_lidars.hpp"

#include <algorithm>
#include <functional>
#include <utility>

#include "hil/sensors/lidar/body_motion.hpp"
#include "hil/sensors/lidar/car_mesh.hpp"
#include "hil/sensors/lidar/track_mesh.hpp"

namespace pitwall::bench {
namespace {

constexpr std::uint64_t kStream = 0x11DA5;

}  // namespace

perception::SensorPose pose_of(const sensors::SensorMount& mount) {
  return {mount.at_m[0],
          mount.at_m[1],
          mount.at_m[2],
          mount.attitude.roll_rad,
          mount.attitude.pitch_rad,
          mount.attitude.yaw_rad};
}

perception::PointCloud points_of(std::span<const sensors::LidarReturn> returns) {
  perception::PointCloud points;
  points.reserve(returns.size());
  for (const sensors::LidarReturn& back : returns)
    points.push_back({back.x_m, back.y_m, back.z_m, back.intensity, back.after_s});
  return points;
}

SweptLidars::SweptLidars(const world::TrackMap& track, std::size_t others, std::uint64_t seed,
                         std::optional<perception::PillarDetector> network)
    : track_(track),
      latency_(network ? kByNetwork : kByClusters),
      rays_(sensors::track_meshes(track)),
      noise_(seed, kStream),
      detector_(track, {}, std::move(network)) {
  const std::vector<sensors::Mesh> body = sensors::car_meshes(sensors::av21_shape());
  for (std::size_t car = 0; car < others; ++car) rays_.add_car(body);
}

void SweptLidars::step(const plant::Truth& ours, std::span<const plant::CarPose> others,
                       const world::EgoState& ego, const faults::LidarFault& fault, Instant now,
                       sensors::Arrivals& out) {
  if (now >= next_) {
    next_ = now + kPeriod;
    if (!std::ranges::all_of(fault.outage, std::identity{}))
      under_way_.push_back(sweep(ours, others, ego, fault, now));
  }
  while (!under_way_.empty() && under_way_.front().received <= now && out.push(under_way_.front()))
    under_way_.pop_front();
}

world::DetectionFrame SweptLidars::sweep(const plant::Truth& ours,
                                         std::span<const plant::CarPose> others,
                                         const world::EgoState& ego,
                                         const faults::LidarFault& fault, Instant now) {
  std::vector<sensors::BodyMotion> cars;
  for (const plant::CarPose& car : others) cars.push_back(sensors::motion_on_road(track_, car));
  const sensors::BodyMotion body = sensors::motion_of(ours);
  std::vector<perception::PointCloud> clouds(units_.size());
  std::vector<perception::LidarSweep> sweeps;
  for (std::size_t k = 0; k < units_.size(); ++k) {
    if (fault.outage[k]) continue;
    clouds[k] = points_of(sensors::lidar_sweep(units_[k], rays_, {body, cars, {}}, noise_));
    sweeps.push_back({pose_of(units_[k].mount), clouds[k], -sensors::kHorizon.seconds()});
  }
  world::DetectionFrame frame = detector_.detect(sweeps, ego, now + sensors::kHorizon);
  frame.received = now + latency_ + fault.added_latency;
  return frame;
}

}  // namespace pitwall::bench
