// Cars of the bench as bodies, for rays: of the true state of one, or of another one's rectangle on
// the banked road.
//   frames the car's rectangle in Map; out: Vehicle (mesh.hpp), or another origin above it
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hil/plant/car_pose.hpp"
#include "hil/sensors/geometry.hpp"
#include "hil/sensors/lidar/lidar.hpp"
#include "vehicle/world/track_map.hpp"

namespace pitwall::sensors {

inline Moving standing(const world::TrackMap& track, const plant::CarPose& car,
                       double over_m = 0.0) {
  const world::RoadPoint road = track.road(car.s_m, car.n_m);
  Moving body;
  body.attitude = {.roll_rad = -road.bank_rad, .yaw_rad = car.yaw_rad};
  const Rotation axes = rotation(body.attitude);
  body.at_m = plus({car.x_m, car.y_m, road.height_m}, times(over_m, axes[2]));
  body.velocity_mps = plus(times(car.vx_mps, axes[0]), times(car.vy_mps, axes[1]));
  body.yaw_rate_rad_per_s = car.yaw_rate_rad_per_s;
  return body;
}

// Body, as it is.
inline Moving moving(const plant::Truth& t) {
  return {.at_m = {t.x_m, t.y_m, t.z_m},
          .attitude = {t.roll_rad, t.pitch_rad, t.yaw_rad},
          .velocity_mps = {t.map_vx_mps, t.map_vy_mps, t.map_vz_mps},
          .yaw_rate_rad_per_s = t.heading_rate_rad_per_s};
}

}  // namespace pitwall::sensors
