// Our car along the reference line of the oval, as it knows itself.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tests/hil/traffic/oval.hpp"
#include "vehicle/world/ego_state.hpp"

namespace pitwall::perception {

inline world::EgoState ego_on_oval(double s_m, double speed_mps, Instant at) {
  const world::TrackPoint road = traffic::oval().at(s_m);
  return {.at = at,
          .validity = world::Validity::kGood,
          .x_m = road.x_m,
          .y_m = road.y_m,
          .yaw_rad = road.yaw_rad,
          .vx_mps = speed_mps,
          .vy_mps = 0.0,
          .yaw_rate_rad_per_s = 0.0};
}

}  // namespace pitwall::perception
