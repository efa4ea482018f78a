// SPDX-License-Identifier: Apache-2.0
#include "hil/sensors/lidar/random_scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "hil/sensors/lidar/standing.hpp"
#include "hil/sensors/lidar/track_mesh.hpp"
#include "protocol/vocabulary/check.hpp"

namespace pitwall::sensors {
namespace {

constexpr double kBehind_m = 100.0, kAhead_m = 125.0;
constexpr double kLengthApart_m = 7.0, kWidthApart_m = 2.6, kWallApart_m = 1.3;

struct OnTrack {
  double s_m, n_m, speed_mps, turned_rad;
};

double between(Noise& noise, double least, double most) {
  return least + (most - least) * noise.uniform();
}

Moving standing_on(const world::TrackMap& track, const OnTrack& car, double over_m) {
  const world::TrackPoint road = track.offset(car.s_m, car.n_m);
  const plant::CarPose pose{.x_m = road.x_m,
                            .y_m = road.y_m,
                            .yaw_rad = road.yaw_rad + car.turned_rad,
                            .vx_mps = car.speed_mps,
                            .vy_mps = 0.0,
                            .yaw_rate_rad_per_s = car.speed_mps * road.curvature_per_m,
                            .s_m = car.s_m,
                            .n_m = car.n_m};
  return standing(track, pose, over_m);
}

double drawn_offset_m(const world::TrackMap& track, double s_m, Noise& noise) {
  const world::TrackPoint at = track.at(s_m);
  return between(noise, -at.width_right_m + kWallApart_m, at.width_left_m - kWallApart_m);
}

std::vector<OnTrack> drawn_cars(const world::TrackMap& track, const OnTrack& ours,
                                double spun_share, Noise& noise) {
  std::vector<OnTrack> cars{ours};
  const std::size_t count = noise.next() % (kSceneCarsMost + 1);
  for (int attempt = 0; attempt < 50 && cars.size() < count + 1; ++attempt) {
    const double s_m = track.wrap_station(ours.s_m + between(noise, -kBehind_m, kAhead_m));
    const OnTrack car{s_m, drawn_offset_m(track, s_m, noise),
                      std::max(0.0, ours.speed_mps + between(noise, -15.0, 15.0)),
                      from_deg(3.0) * std::clamp(noise.normal(), -2.0, 2.0)};
    const bool is_free = std::ranges::all_of(cars, [&](const OnTrack& other) {
      return std::abs(std::remainder(car.s_m - other.s_m, track.length_m())) > kLengthApart_m ||
             std::abs(car.n_m - other.n_m) > kWidthApart_m;
    });
    if (!is_free) continue;
    cars.push_back(car);
    if (spun_share > 0.0 && noise.uniform() < spun_share) {
      cars.back().speed_mps = 0.0;
      cars.back().turned_rad = between(noise, -std::numbers::pi, std::numbers::pi);
    }
  }
  cars.erase(cars.begin());
  return cars;
}

void add_trail(const Moving& car, double dust, Noise& noise, std::vector<DustCloud>& clouds) {
  const Rotation axes = rotation(car.attitude);
  for (const double behind_m : {3.5, 5.5, 8.5, 12.0}) {
    const Vector3 at =
        plus(car.at_m, plus(times(-behind_m, axes[0]), times(between(noise, 0.3, 0.9), axes[2])));
    clouds.push_back(
        {at, between(noise, 0.5, 0.8) + 0.06 * behind_m, dust * between(noise, 0.02, 0.12)});
  }
}

std::vector<DustCloud> drawn_dust(const world::TrackMap& track, const OnTrack& ours,
                                  std::span<const Moving> cars, double dust, Noise& noise) {
  std::vector<DustCloud> clouds;
  if (dust <= 0.0) return clouds;
  for (const Moving& car : cars)
    if (noise.uniform() < 1.0 / 3.0) add_trail(car, dust, noise, clouds);
  if (noise.uniform() < 0.25) {
    const double s_m = track.wrap_station(ours.s_m + between(noise, 10.0, 80.0));
    const OnTrack blown{s_m, drawn_offset_m(track, s_m, noise), 0.0, 0.0};
    add_trail(standing_on(track, blown, 0.0), dust, noise, clouds);
  }
  return clouds;
}

Moving sprung(Moving body, Noise& noise) {
  body.attitude.roll_rad += from_deg(0.4) * noise.normal();
  body.attitude.pitch_rad += from_deg(0.4) * noise.normal();
  body.at_m[2] += 0.01 * noise.normal();
  return body;
}

// Both at one time.
TrueBox box_of(const Moving& ours, const Moving& car, const CarShape& shape) {
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
  const double length = factor(0.08), width = factor(0.06), height = factor(0.12);
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
    : track_(&track), bodies_(bodies), rules_(rules), rays_(track_meshes(track)) {
  CHECK(!bodies_.empty());
  for (std::size_t car = 0; car < kSceneCarsMost; ++car) rays_.add_car(car_meshes(shape_of(car)));
}

LidarScene SceneMaker::make(std::uint64_t seed) {
  Noise noise{seed, 0x11DA4};
  const double s_m = between(noise, 0.0, track_->length_m());
  const OnTrack ours{s_m, drawn_offset_m(*track_, s_m, noise), between(noise, 20.0, 75.0),
                     from_deg(1.0) * noise.normal()};
  std::vector<Moving> cars;
  for (const OnTrack& car : drawn_cars(*track_, ours, rules_.spun_share, noise))
    cars.push_back(standing_on(*track_, car, 0.0));
  const std::vector<DustCloud> dust = drawn_dust(*track_, ours, cars, rules_.dust, noise);
  const Moving body = sprung(standing_on(*track_, ours, kOriginOverRoad_m), noise);
  for (std::size_t car = 0; car < kSceneCarsMost; ++car) rays_.hide(car);

  LidarScene scene;
  const Moving then = after(body, kReference_s);
  for (std::size_t car = 0; car < cars.size(); ++car)
    scene.cars.push_back(box_of(then, after(cars[car], kReference_s), shape_of(car)));
  for (const LidarUnit& unit : av21_lidars()) {
    scene.sweeps.push_back({unit.mount, lidar_sweep(unit, rays_, {body, cars, dust}, noise)});
    for (const LidarReturn& back : scene.sweeps.back().returns)
      if (back.car >= 0) ++scene.cars[static_cast<std::size_t>(back.car)].returns;
  }
  scene.x_m = then.at_m[0] + 0.05 * noise.normal();
  scene.y_m = then.at_m[1] + 0.05 * noise.normal();
  scene.yaw_rad = then.attitude.yaw_rad + from_deg(0.1) * noise.normal();
  scene.speed_mps = ours.speed_mps;
  scene.yaw_rate_rad_per_s = body.yaw_rate_rad_per_s;
  return scene;
}

}  // namespace pitwall::sensors
