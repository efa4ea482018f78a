// SPDX-License-Identifier: Apache-2.0
#include "hil/sensors/camera/camera_scene.hpp"

#include <algorithm>
#include <cmath>

#include "hil/sensors/lidar/drawn_cars.hpp"

namespace pitwall::sensors {
namespace {

// In another frame: x along its first axis.
Vector3 seen_from(const SensorFrame& frame, const Vector3& at) {
  const Vector3 apart = plus(at, times(-1.0, frame.at_m));
  return {dot(apart, frame.axes[0]), dot(apart, frame.axes[1]), dot(apart, frame.axes[2])};
}

perception::Pixel pixel_of(const CameraUnit& unit, const Vector3& in_camera) {
  return perception::project(unit.optics,
                             {-in_camera[1] / in_camera[0], -in_camera[2] / in_camera[0]});
}

CameraUnit drawn_unit(std::uint64_t seed, bool varied, Noise& noise) {
  CameraUnit unit = av21_front_cameras()[seed % 2];
  if (!varied) return unit;
  for (double& place_m : unit.mount.at_m) place_m += between(noise, -0.2, 0.2);
  unit.mount.attitude.roll_rad += from_deg(1.5) * noise.normal();
  unit.mount.attitude.pitch_rad += from_deg(1.0) * noise.normal();
  unit.mount.attitude.yaw_rad += from_deg(3.0) * noise.normal();
  const double factor = between(noise, 0.85, 1.2);
  unit.optics.focal_x_px *= factor, unit.optics.focal_y_px *= factor;
  return unit;
}

// About the corners of its outer block; what lies beside the camera does not widen it.
SeenCar seen(const CameraUnit& unit, const BodyMotion& ours, const BodyMotion& car,
             const CarShape& shape) {
  constexpr double kNearest_m = 0.5;
  const SensorFrame camera = frame_of(unit.mount, ours);
  const Rotation axes = rotation(car.attitude);
  const auto in_camera = [&](double x_m, double y_m, double z_m) {
    return seen_from(camera, plus(car.at_m, turned(axes, {x_m, y_m, z_m})));
  };
  SeenCar out;
  const Vector3 middle = in_camera(0.0, 0.0, 0.5 * shape.height_m);
  if (middle[0] < kNearest_m) return out;
  out.depth_m = middle[0];
  out.upright_px = unit.optics.focal_y_px * shape.height_m / middle[0];
  const perception::Pixel centre = pixel_of(unit, middle);
  out.u_px = centre.u_px, out.v_px = centre.v_px;
  double left_px = centre.u_px, right_px = left_px, upper_px = centre.v_px, lower_px = upper_px;
  for (const double x_m : {-0.5 * shape.length_m, 0.5 * shape.length_m})
    for (const double y_m : {-0.5 * shape.width_m, 0.5 * shape.width_m})
      for (const double z_m : {0.0, shape.height_m}) {
        Vector3 corner = in_camera(x_m, y_m, z_m);
        corner[0] = std::max(corner[0], kNearest_m);
        const perception::Pixel at = pixel_of(unit, corner);
        left_px = std::min(left_px, at.u_px), right_px = std::max(right_px, at.u_px);
        upper_px = std::min(upper_px, at.v_px), lower_px = std::max(lower_px, at.v_px);
      }
  out.width_px = right_px - left_px, out.height_px = lower_px - upper_px;
  const Vector3 in_body = seen_from({ours.at_m, rotation(ours.attitude)}, car.at_m);
  out.x_m = in_body[0], out.y_m = in_body[1];
  return out;
}

}  // namespace

CameraSceneMaker::CameraSceneMaker(const world::TrackMap& track,
                                   const std::vector<CarShape>& bodies, const CameraRules& rules)
    : track_(&track),
      bodies_(bodies),
      rules_(rules),
      rays_(scene_with_cars(track_scene_meshes(track), bodies)),
      decoys_(rules.decoys, rays_) {}

CameraScene CameraSceneMaker::make(std::uint64_t seed) {
  Noise noise{seed, 0xCA3E4A};
  const DrawnCars drawn = draw_cars(*track_, rules_.spun_share, noise);
  const std::vector<DustCloud> dust = draw_dust(*track_, drawn, rules_.dust, noise);
  const BodyMotion body = sprung_body(*track_, drawn.ours, noise);
  for (std::size_t car = 0; car < kSceneCarsMost; ++car) rays_.hide(car);
  decoys_.place_drawn(*track_, drawn, seed, rays_);
  place_cars(drawn.others, rays_);
  CameraScene scene{.unit = drawn_unit(seed, rules_.varied, noise), .image = {}, .cars = {}};
  const Look look = draw_look(kSceneCarsMost, noise);
  scene.image = camera_image(scene.unit, rays_, {body, drawn.others, dust}, look, noise);
  for (std::size_t car = 0; car < drawn.others.size(); ++car) {
    SeenCar of = seen(scene.unit, body, drawn.others[car], shape_of(bodies_, car));
    of.pixels = static_cast<std::size_t>(
        std::ranges::count(scene.image.car, static_cast<std::int8_t>(car)));
    if (of.pixels > 0 && !std::isnan(of.u_px)) scene.cars.push_back(of);
  }
  return scene;
}

}  // namespace pitwall::sensors
