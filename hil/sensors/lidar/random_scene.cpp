// SPDX-License-Identifier: Apache-2.0
#include "hil/sensors/lidar/random_scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "hil/sensors/lidar/body_motion.hpp"
#include "hil/sensors/lidar/track_mesh.hpp"

namespace pitwall::sensors {
namespace {

// Both at one time.
TrueBox box_of(const BodyMotion& ours, const BodyMotion& car, const CarShape& shape) {
  const Rotation axes = rotation(ours.attitude);
  const Vector3 apart = plus(car.at_m, times(-1.0, ours.at_m));
  return {.x_m = dot(apart, axes[0]),
          .y_m = dot(apart, axes[1]),
          .yaw_rad = car.attitude.yaw_rad - ours.attitude.yaw_rad,
          .length_m = shape.length_m,
          .width_m = shape.width_m};
}

// The whole and each of its parts a little larger or smaller.
CarShape varied(const CarShape& shape, Noise& noise) {
  const auto factor = [&](double share) { return between(noise, 1.0 - share, 1.0 + share); };
  const double length = factor(0.08), width = factor(0.06), height = factor(0.2);
  const auto stretched = [&](const Block::Face& face) {
    return Block::Face{length * face.x_m, width * face.half_width_m * factor(0.1),
                       height * face.low_m, height * face.high_m * factor(0.05)};
  };
  CarShape body{.name = "drawn",
                .length_m = length * shape.length_m,
                .width_m = width * shape.width_m,
                .height_m = height * shape.height_m,
                .blocks = {},
                .wheels = {},
                .body_reflectance = static_cast<float>(between(noise, 0.08, 0.7))};
  for (const Block& block : shape.blocks)
    body.blocks.push_back({stretched(block.rear), stretched(block.front), width * block.aside_m});
  for (const Wheel& wheel : shape.wheels)
    body.wheels.push_back({length * wheel.x_m, width * wheel.aside_m, wheel.radius_m * factor(0.08),
                           wheel.width_m * factor(0.1)});
  return body;
}

}  // namespace

std::vector<CarShape> bodies_like(const CarShape& shape, std::size_t count, std::uint64_t seed) {
  Noise noise{seed, 0xB0D1E5};
  std::vector<CarShape> bodies;
  for (std::size_t i = 0; i < count; ++i) bodies.push_back(varied(shape, noise));
  return bodies;
}

SceneMaker::SceneMaker(const world::TrackMap& track, const std::vector<CarShape>& bodies,
                       const SceneRules& rules)
    : track_(&track),
      bodies_(bodies),
      rules_(rules),
      rays_(scene_with_cars(track_meshes(track), bodies)),
      decoys_(rules.decoys, rays_) {}

LidarScene SceneMaker::make(std::uint64_t seed) {
  Noise noise{seed, 0x11DA4};
  const DrawnCars drawn = draw_cars(*track_, rules_.spun_share, noise);
  const std::vector<BodyMotion>& cars = drawn.others;
  const std::vector<DustCloud> dust = draw_dust(*track_, drawn, rules_.dust, noise);
  const BodyMotion body = sprung_body(*track_, drawn.ours, noise);
  for (std::size_t car = 0; car < kSceneCarsMost; ++car) rays_.hide(car);
  decoys_.place_drawn(*track_, drawn, seed, rays_);

  LidarScene scene;
  const BodyMotion then = after(body, kReference_s);
  for (std::size_t car = 0; car < cars.size(); ++car)
    scene.cars.push_back(box_of(then, after(cars[car], kReference_s), shape_of(bodies_, car)));
  for (const LidarUnit& unit : av21_lidars()) {
    scene.sweeps.push_back({unit.mount, lidar_sweep(unit, rays_, {body, cars, dust}, noise)});
    for (const LidarReturn& back : scene.sweeps.back().returns)
      if (const auto car = static_cast<std::size_t>(back.car); car < scene.cars.size())
        ++scene.cars[car].returns;
  }
  scene.x_m = then.at_m[0] + 0.05 * noise.normal();
  scene.y_m = then.at_m[1] + 0.05 * noise.normal();
  scene.yaw_rad = then.attitude.yaw_rad + from_deg(0.1) * noise.normal();
  scene.speed_mps = drawn.ours.speed_mps;
  scene.yaw_rate_rad_per_s = body.yaw_rate_rad_per_s;
  return scene;
}

}  // namespace pitwall::sensors
