// SPDX-License-Identifier: Apache-2.0
#include "basestation/state/derived/ghost.hpp"

#include <cmath>

namespace pitwall::state {

std::optional<Ghost> ghost_of(const LastPlace& last, Duration age, const Course* course) {
  if (age < kGhostAfter || age > kGhostFor) return std::nullopt;
  if (!std::isfinite(last.x_m) || !std::isfinite(last.y_m) || !std::isfinite(last.yaw_rad) ||
      !std::isfinite(last.speed_mps)) {
    return std::nullopt;
  }
  const double age_s = age.seconds(), driven_m = last.speed_mps * age_s;
  const double sigma_m = std::isfinite(last.sigma_m) ? last.sigma_m : 0.0;
  const double radius_m = sigma_m + 0.5 * kUnknownAccel_mps2 * age_s * age_s;
  if (course != nullptr && std::isfinite(last.station_m) && std::isfinite(last.offset_m)) {
    const CoursePose pose = course->at(last.station_m + driven_m, last.offset_m);
    return Ghost{.x_m = pose.x_m, .y_m = pose.y_m, .yaw_rad = pose.yaw_rad, .radius_m = radius_m};
  }
  return Ghost{.x_m = last.x_m + driven_m * std::cos(last.yaw_rad),
               .y_m = last.y_m + driven_m * std::sin(last.yaw_rad),
               .yaw_rad = last.yaw_rad,
               .radius_m = radius_m};
}

}  // namespace pitwall::state
