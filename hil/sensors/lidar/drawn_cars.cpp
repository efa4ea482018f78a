// SPDX-License-Identifier: Apache-2.0
#include "hil/sensors/lidar/drawn_cars.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hil/sensors/lidar/body_motion.hpp"
#include "protocol/vocabulary/check.hpp"

namespace pitwall::sensors {
namespace {

constexpr double kBehind_m = 100.0, kAhead_m = 125.0;
constexpr double kLengthApart_m = 7.0, kWidthApart_m = 2.6, kWallApart_m = 1.3;

double drawn_offset_m(const world::TrackMap& track, double s_m, Noise& noise) {
  const world::TrackPoint at = track.at(s_m);
  return between(noise, -at.width_right_m + kWallApart_m, at.width_left_m - kWallApart_m);
}

std::vector<OnTrack> drawn_others(const world::TrackMap& track, const OnTrack& ours,
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

void add_trail(const BodyMotion& car, double dust, Noise& noise, std::vector<DustCloud>& clouds) {
  const Rotation axes = rotation(car.attitude);
  for (const double behind_m : {3.5, 5.5, 8.5, 12.0}) {
    const Vector3 at =
        plus(car.at_m, plus(times(-behind_m, axes[0]), times(between(noise, 0.3, 0.9), axes[2])));
    clouds.push_back(
        {at, between(noise, 0.5, 0.8) + 0.06 * behind_m, dust * between(noise, 0.02, 0.12)});
  }
}

}  // namespace

BodyMotion motion_on_track(const world::TrackMap& track, const OnTrack& car, double over_m) {
  const world::TrackPoint road = track.offset(car.s_m, car.n_m);
  const plant::CarPose pose{.x_m = road.x_m,
                            .y_m = road.y_m,
                            .yaw_rad = road.yaw_rad + car.turned_rad,
                            .vx_mps = car.speed_mps,
                            .vy_mps = 0.0,
                            .yaw_rate_rad_per_s = car.speed_mps * road.curvature_per_m,
                            .s_m = car.s_m,
                            .n_m = car.n_m};
  return motion_on_road(track, pose, over_m);
}

DrawnCars draw_cars(const world::TrackMap& track, double spun_share, Noise& noise) {
  const double s_m = between(noise, 0.0, track.length_m());
  DrawnCars drawn{.ours = {s_m, drawn_offset_m(track, s_m, noise), between(noise, 20.0, 75.0),
                           from_deg(1.0) * noise.normal()},
                  .others = {}};
  for (const OnTrack& car : drawn_others(track, drawn.ours, spun_share, noise))
    drawn.others.push_back(motion_on_track(track, car));
  return drawn;
}

std::vector<DustCloud> draw_dust(const world::TrackMap& track, const DrawnCars& cars,
                                 double density, Noise& noise) {
  std::vector<DustCloud> clouds;
  if (density <= 0.0) return clouds;
  for (const BodyMotion& car : cars.others)
    if (noise.uniform() < 1.0 / 3.0) add_trail(car, density, noise, clouds);
  if (noise.uniform() < 0.25) {
    const double s_m = track.wrap_station(cars.ours.s_m + between(noise, 10.0, 80.0));
    const OnTrack blown{s_m, drawn_offset_m(track, s_m, noise), 0.0, 0.0};
    add_trail(motion_on_track(track, blown), density, noise, clouds);
  }
  return clouds;
}

RayScene scene_with_cars(std::span<const Mesh> still, std::span<const CarShape> bodies) {
  CHECK(!bodies.empty());
  RayScene rays{still};
  for (std::size_t car = 0; car < kSceneCarsMost; ++car)
    rays.add_car(car_meshes(shape_of(bodies, car)));
  return rays;
}

BodyMotion sprung_body(const world::TrackMap& track, const OnTrack& ours, Noise& noise) {
  BodyMotion body = motion_on_track(track, ours, kOriginOverRoad_m);
  body.attitude.roll_rad += from_deg(0.4) * noise.normal();
  body.attitude.pitch_rad += from_deg(0.4) * noise.normal();
  body.at_m[2] += 0.01 * noise.normal();
  return body;
}

}  // namespace pitwall::sensors
