// SPDX-License-Identifier: Apache-2.0
#include "hil/sensors/lidar/lidar.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace pitwall::sensors {
namespace {

// Where dust sends a ray back, if it does: how far away.
std::optional<double> met_dust(std::span<const DustCloud> dust, const Vector3& from,
                               const Vector3& along, Noise& noise) {
  std::optional<double> nearest_m;
  for (const DustCloud& cloud : dust) {
    const Vector3 to = plus(cloud.at_m, times(-1.0, from));
    const double closest_m = dot(to, along);
    if (closest_m <= 0.0) continue;
    const double aside2_m2 = dot(to, to) - closest_m * closest_m;
    const double spread = aside2_m2 / (2.0 * cloud.sigma_m * cloud.sigma_m);
    if (spread > 6.0) continue;
    const double depth = cloud.extinction_per_m * cloud.sigma_m *
                         std::sqrt(2.0 * std::numbers::pi) * std::exp(-spread);
    if (noise.uniform() >= 1.0 - std::exp(-depth)) continue;
    const double at_m = closest_m + cloud.sigma_m * noise.normal();
    if (at_m > 0.0 && (!nearest_m || at_m < *nearest_m)) nearest_m = at_m;
  }
  return nearest_m;
}

bool is_received(double signal, double range_m, const LidarErrors& errors, Noise& noise) {
  if (noise.uniform() < errors.lost_share) return false;
  const double share = errors.reach_m / range_m;
  const double strength = signal / errors.reach_reflectance * share * share *
                          std::exp(errors.signal_sigma * noise.normal());
  return strength >= 1.0;
}

class Sweep {
 public:
  Sweep(const LidarUnit& unit, const RayScene& scene, const LidarWorld& world, Noise& noise)
      : unit_(unit), scene_(scene), world_(world), noise_(noise) {}

  void scan(int ring, double time_s, std::vector<LidarReturn>& out) {
    const SensorFrame pose = frame_of(unit_.mount, after(world_.ours, time_s));
    for (int column = 0; column < columns_of(unit_.pattern); ++column) {
      const Vector3 ray = ray_of(unit_.pattern, ring, column);
      shoot(pose.at_m, turned(pose.axes, ray), ray, time_s, out);
    }
  }

 private:
  void shoot(const Vector3& from, const Vector3& along, const Vector3& ray, double time_s,
             std::vector<LidarReturn>& out) {
    constexpr double kDustReflectance = 0.05;
    std::optional<Meeting> met = scene_.first(from, along, unit_.errors.most_m);
    if (const auto dust_m = met_dust(world_.dust, from, along, noise_);
        dust_m && (!met || *dust_m < met->range_m))
      met = Meeting{.range_m = *dust_m, .cos_incidence = 1.0, .reflectance = kDustReflectance};
    if (!met) return;
    if (const auto back = received(*met, ray, time_s, unit_.errors, noise_)) out.push_back(*back);
  }

  const LidarUnit& unit_;
  const RayScene& scene_;
  const LidarWorld& world_;
  Noise& noise_;
};

}  // namespace

std::vector<LidarUnit> av21_lidars() {
  const auto facing = [](double x_m, double y_m, double yaw_deg) {
    LidarUnit unit;
    unit.mount = {{x_m, y_m, 0.55}, {.yaw_rad = from_deg(yaw_deg)}};
    return unit;
  };
  return {facing(1.0, 0.0, 0.0), facing(-0.4, 0.35, 120.0), facing(-0.4, -0.35, -120.0)};
}

SensorFrame frame_of(const SensorMount& mount, const BodyMotion& body) {
  const Rotation axes = rotation(body.attitude), in_body = rotation(mount.attitude);
  return {plus(body.at_m, turned(axes, mount.at_m)),
          {turned(axes, in_body[0]), turned(axes, in_body[1]), turned(axes, in_body[2])}};
}

void place_cars(std::span<const BodyMotion> cars, RayScene& scene) {
  for (std::size_t car = 0; car < cars.size(); ++car)
    scene.place(car, rotation(cars[car].attitude), cars[car].at_m);
  scene.commit();
}

int columns_of(const LidarPattern& pattern) {
  return static_cast<int>(std::ceil(2.0 * pattern.half_width_rad / pattern.ray_step_rad));
}

Vector3 ray_of(const LidarPattern& pattern, int ring, int column) {
  const double up_rad = pattern.top_rad - ring * pattern.ring_step_rad;
  const double left_rad = column * pattern.ray_step_rad - pattern.half_width_rad;
  return {std::cos(up_rad) * std::cos(left_rad), std::cos(up_rad) * std::sin(left_rad),
          std::sin(up_rad)};
}

std::optional<LidarReturn> received(const Meeting& met, const Vector3& ray, double after_s,
                                    const LidarErrors& errors, Noise& noise) {
  const double signal = met.reflectance * met.cos_incidence;
  if (met.range_m < errors.least_m || !is_received(signal, met.range_m, errors, noise))
    return std::nullopt;
  const double range_m = met.range_m + errors.range_sigma_m * noise.normal();
  return LidarReturn{static_cast<float>(range_m * ray[0]),
                     static_cast<float>(range_m * ray[1]),
                     static_cast<float>(range_m * ray[2]),
                     static_cast<float>(signal),
                     static_cast<float>(after_s),
                     static_cast<std::int16_t>(met.car ? static_cast<int>(*met.car) : -1)};
}

std::vector<LidarReturn> lidar_sweep(const LidarUnit& unit, RayScene& scene,
                                     const LidarWorld& world, Noise& noise) {
  std::vector<LidarReturn> returns;
  Sweep sweep{unit, scene, world, noise};
  for (int ring = 0; ring < unit.pattern.rings; ++ring) {
    const double time_s = ring * unit.pattern.ring_period_s;
    std::vector<BodyMotion> cars;
    for (const BodyMotion& car : world.cars) cars.push_back(after(car, time_s));
    place_cars(cars, scene);
    sweep.scan(ring, time_s, returns);
  }
  return returns;
}

}  // namespace pitwall::sensors
