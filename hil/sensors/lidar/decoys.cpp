// SPDX-License-Identifier: Apache-2.0
#include "hil/sensors/lidar/decoys.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "hil/sensors/noise.hpp"

namespace pitwall::sensors {
namespace {

constexpr double kLeastAhead_m = -60.0, kMostAhead_m = 125.0, kFromWall_m = 0.5, kFromCar_m = 4.0;

// About the thing's middle.
Block block(double length_m, double width_m, double low_m, double high_m) {
  const double half_m = 0.5 * length_m, half_width_m = 0.5 * width_m;
  return {{-half_m, half_width_m, low_m, high_m}, {half_m, half_width_m, low_m, high_m}};
}

CarShape thing(std::string_view name, std::vector<Block> blocks, float reflectance) {
  CarShape shape{.name = name,
                 .length_m = 0.0,
                 .width_m = 0.0,
                 .height_m = 0.0,
                 .blocks = std::move(blocks),
                 .wheels = {},
                 .body_reflectance = reflectance};
  for (const Block& part : shape.blocks) {
    shape.length_m = std::max(shape.length_m, 2.0 * part.front.x_m);
    shape.width_m = std::max(shape.width_m, 2.0 * part.front.half_width_m);
    shape.height_m = std::max(shape.height_m, part.front.high_m);
  }
  return shape;
}

bool is_near(const BodyMotion& body, const Vector3& at) {
  return std::hypot(body.at_m[0] - at[0], body.at_m[1] - at[1]) < kFromCar_m;
}

std::optional<BodyMotion> drawn_place(const world::TrackMap& track, const DrawnCars& cars,
                                      Noise& noise) {
  const double s_m =
      track.wrap_station(cars.ours.s_m + between(noise, kLeastAhead_m, kMostAhead_m));
  const world::TrackPoint road = track.at(s_m);
  const OnTrack place{
      s_m, between(noise, -road.width_right_m + kFromWall_m, road.width_left_m - kFromWall_m), 0.0,
      between(noise, -std::numbers::pi, std::numbers::pi)};
  if (noise.uniform() >= kDecoyShare) return std::nullopt;
  const BodyMotion decoy = motion_on_track(track, place);
  const auto is_at_it = [&](const BodyMotion& car) { return is_near(car, decoy.at_m); };
  if (is_at_it(motion_on_track(track, cars.ours)) || std::ranges::any_of(cars.others, is_at_it))
    return std::nullopt;
  return decoy;
}

}  // namespace

std::vector<CarShape> decoy_shapes(DecoySet set) {
  switch (set) {
    case DecoySet::kNone:
      return {};
    case DecoySet::kCommon:
      return {
          thing("traffic cone",
                {block(0.40, 0.40, 0.0, 0.04), block(0.28, 0.28, 0.04, 0.40),
                 block(0.12, 0.12, 0.40, 0.75)},
                0.5F),
          thing("marshal",
                {block(0.30, 0.40, 0.0, 0.85), block(0.35, 0.55, 0.85, 1.45),
                 block(0.22, 0.20, 1.45, 1.75)},
                0.4F),
          thing("stack of tyres", {block(0.65, 0.65, 0.0, 1.0)}, 0.06F),
          thing("marker board", {block(0.08, 0.08, 0.0, 0.50), block(0.06, 1.20, 0.50, 1.50)},
                0.6F),
          thing("lost wing", {block(0.50, 1.70, 0.0, 0.18)}, 0.3F),
          thing("barrier", {block(2.00, 0.60, 0.0, 0.30), block(2.00, 0.30, 0.30, 0.80)}, 0.35F)};
    case DecoySet::kRare:
      return {thing("barrel", {block(0.58, 0.58, 0.0, 0.90)}, 0.3F),
              thing("straw bale", {block(1.20, 0.50, 0.0, 0.50)}, 0.35F),
              thing("quad bike and rider",
                    {block(1.90, 1.10, 0.20, 0.80), block(0.40, 0.50, 0.80, 1.50)}, 0.3F)};
  }
  return {};
}

Decoys::Decoys(DecoySet set, RayScene& rays) : set_(set) {
  for (const CarShape& shape : decoy_shapes(set)) {
    const std::vector<Mesh> meshes = car_meshes(shape);
    numbers_.push_back(rays.add_car(std::span{meshes}.first(1)));  // without tyres
    rays.hide(numbers_.back());
  }
}

void Decoys::place_drawn(const world::TrackMap& track, const DrawnCars& cars, std::uint64_t seed,
                         RayScene& rays) const {
  Noise noise{seed, 0xDEC0};
  for (const std::size_t number : numbers_) {
    const auto decoy = drawn_place(track, cars, noise);
    if (!decoy) {
      rays.hide(number);
      continue;
    }
    Rotation axes = rotation(decoy->attitude);
    if (set_ == DecoySet::kCommon)
      for (Vector3& axis : axes) axis = times(between(noise, 0.6, 1.5), axis);
    rays.place(number, axes, decoy->at_m);
  }
}

}  // namespace pitwall::sensors
