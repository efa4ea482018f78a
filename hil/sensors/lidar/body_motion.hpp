// Motion of a car's body, as rays meet it: its pose at one time, its velocity and its yaw rate.
//   in     the true state of our car, or another car's rectangle on the banked road
//   frames Map for position, attitude and velocity. The origin is that of the mesh (Vehicle,
//          mesh.hpp, on the road) or of Body, `over_m` above the road and square to it
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hil/plant/car_pose.hpp"
#include "hil/plant/plant.hpp"
#include "hil/sensors/geometry.hpp"
#include "vehicle/world/track_map.hpp"

namespace pitwall::sensors {

struct BodyMotion {
  Vector3 at_m{};
  Attitude attitude;
  Vector3 velocity_mps{};
  double yaw_rate_rad_per_s = 0.0;
};

// Pose after a time in a straight line with the same yaw rate.
inline BodyMotion after(const BodyMotion& body, double time_s) {
  BodyMotion moved = body;
  moved.at_m = plus(body.at_m, times(time_s, body.velocity_mps));
  moved.attitude.yaw_rad += time_s * body.yaw_rate_rad_per_s;
  return moved;
}

inline BodyMotion motion_on_road(const world::TrackMap& track, const plant::CarPose& car,
                                 double over_m = 0.0) {
  const world::RoadPoint road = track.road(car.s_m, car.n_m);
  BodyMotion body;
  body.attitude = {.roll_rad = -road.bank_rad, .yaw_rad = car.yaw_rad};
  const Rotation axes = rotation(body.attitude);
  body.at_m = plus({car.x_m, car.y_m, road.height_m}, times(over_m, axes[2]));
  body.velocity_mps = plus(times(car.vx_mps, axes[0]), times(car.vy_mps, axes[1]));
  body.yaw_rate_rad_per_s = car.yaw_rate_rad_per_s;
  return body;
}

// Of our car: its origin is that of Body.
inline BodyMotion motion_of(const plant::Truth& t) {
  return {.at_m = {t.x_m, t.y_m, t.z_m},
          .attitude = {t.roll_rad, t.pitch_rad, t.yaw_rad},
          .velocity_mps = {t.map_vx_mps, t.map_vy_mps, t.map_vz_mps},
          .yaw_rate_rad_per_s = t.heading_rate_rad_per_s};
}

}  // namespace pitwall::sensors
