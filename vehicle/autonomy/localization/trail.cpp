// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/localization/trail.hpp"

#include <Eigen/Core>
#include <cmath>

#include "vehicle/autonomy/localization/filter/rotation.hpp"

namespace pitwall::localization {
namespace {

Eigen::Matrix3d rotation(const Moment& m) {
  return rotation_of({m.yaw_rad, m.pitch_rad, m.roll_rad}).toRotationMatrix();
}

double known(double value, double otherwise) { return std::isfinite(value) ? value : otherwise; }

Moment moved(const Moment& from, Instant to) {
  Moment m = from;
  const double dt_s = (to - from.at).seconds();
  m.at = to;
  m.x_m += dt_s * from.velocity_mps[0];
  m.y_m += dt_s * from.velocity_mps[1];
  m.z_m += dt_s * from.velocity_mps[2];
  // Yaw turns about the vertical, the rates about the axes of the car.
  const double turn_rad = dt_s *
                          (from.rate_rad_per_s[1] * std::sin(from.roll_rad) +
                           from.rate_rad_per_s[2] * std::cos(from.roll_rad)) /
                          std::cos(from.pitch_rad);
  m.yaw_rad = wrap_pi(from.yaw_rad + turn_rad);
  const double c = std::cos(turn_rad), s = std::sin(turn_rad);
  m.velocity_mps[0] = c * from.velocity_mps[0] - s * from.velocity_mps[1];
  m.velocity_mps[1] = s * from.velocity_mps[0] + c * from.velocity_mps[1];
  return m;
}

}  // namespace

Moment::Vector Moment::arm_m(const LeverArm& arm) const {
  const Eigen::Vector3d out = rotation(*this) * Eigen::Vector3d{arm.x_m, arm.y_m, arm.z_m};
  return {out.x(), out.y(), out.z()};
}

Moment::Vector Moment::antenna_mps(const LeverArm& arm) const {
  const Eigen::Vector3d turning =
      Eigen::Vector3d{rate_rad_per_s.data()}.cross(Eigen::Vector3d{arm.x_m, arm.y_m, arm.z_m});
  const Eigen::Vector3d out = Eigen::Vector3d{velocity_mps.data()} + rotation(*this) * turning;
  return {out.x(), out.y(), out.z()};
}

double Moment::azimuth_rad(double direction_rad) const {
  const Eigen::Vector3d body{std::cos(direction_rad), std::sin(direction_rad), 0.0};
  const Eigen::Vector3d map = rotation(*this) * body;
  return std::atan2(map.y(), map.x());
}

double Moment::course_rad() const { return std::atan2(velocity_mps[1], velocity_mps[0]); }

void Trail::note(const Estimate& e, const Road& road) {
  Moment m;
  m.at = e.at;
  m.x_m = e.position_m[0];
  m.y_m = e.position_m[1];
  m.z_m = known(e.position_m[2], known(road.height_m, 0.0));
  m.yaw_rad = e.yaw_rad;
  m.pitch_rad = known(e.pitch_rad, -known(road.climb_rad, 0.0));
  m.roll_rad = known(e.roll_rad, -known(road.bank_rad, 0.0));
  // A car that lies in its road and turns about the vertical pitches in its own frame.
  m.rate_rad_per_s = {known(e.rate_rad_per_s[0], 0.0),
                      known(e.rate_rad_per_s[1], e.rate_rad_per_s[2] * std::tan(m.roll_rad)),
                      e.rate_rad_per_s[2]};
  const Eigen::Vector3d body{known(e.velocity_mps[0], 0.0), known(e.velocity_mps[1], 0.0),
                             known(e.velocity_mps[2], 0.0)};
  const Eigen::Vector3d map = rotation(m) * body;
  m.velocity_mps = {map.x(), map.y(), map.z()};
  m.speed_mps = map.head<2>().norm();
  m.position_sigma_m = e.position_sigma_m;
  m.yaw_sigma_rad = e.yaw_sigma_rad;
  m.speed_sigma_mps = e.speed_sigma_mps;
  moments[next] = m;
  next = (next + 1) % kTrailTicks;
  size = size < kTrailTicks ? size + 1 : size;
}

const Moment* Trail::newest() const {
  return size == 0 ? nullptr : &moments[(next + kTrailTicks - 1) % kTrailTicks];
}

// From the last tick that is not after it; half a tick is the most that the motion is held for.
std::optional<Moment> Trail::at(Instant instant) const {
  for (std::size_t back = 1; back <= size; ++back) {
    const Moment& m = moments[(next + kTrailTicks - back) % kTrailTicks];
    if (m.at > instant) continue;
    if (back == 1 && instant - m.at > kAhead) return std::nullopt;
    return moved(m, instant);
  }
  return std::nullopt;
}

}  // namespace pitwall::localization
