// SPDX-License-Identifier: Apache-2.0
#include "basestation/publishers/ros_view/ground.hpp"

#include <cmath>
#include <numbers>

namespace pitwall::publishers::ros_view {
namespace {

constexpr double kAxis_m = 6'378'137.0, kFlattening = 1.0 / 298.257223563;
constexpr double kPolarAxis_m = kAxis_m * (1.0 - kFlattening);
constexpr double kEccentricity2 = kFlattening * (2.0 - kFlattening);
constexpr double kSecondEccentricity2 = kEccentricity2 / (1.0 - kEccentricity2);
constexpr double kQuarterTurn = 0.5 * std::numbers::pi;

double rad(double deg) { return deg * std::numbers::pi / 180.0; }
double deg(double rad) { return rad * 180.0 / std::numbers::pi; }

double prime_vertical_m(double sine) {
  return kAxis_m / std::sqrt(1.0 - kEccentricity2 * sine * sine);
}

}  // namespace

Ground::Ground(const Geodetic& datum)
    : latitude_rad_(rad(datum.latitude_deg)), longitude_rad_(rad(datum.longitude_deg)) {
  const double sine = std::sin(latitude_rad_), cosine = std::cos(latitude_rad_);
  const double across_m = (prime_vertical_m(sine) + datum.height_m) * cosine;
  origin_ = {across_m * std::cos(longitude_rad_), across_m * std::sin(longitude_rad_),
             (prime_vertical_m(sine) * (1.0 - kEccentricity2) + datum.height_m) * sine};
}

Geodetic Ground::at(double x_m, double y_m, double z_m) const {
  const double sin_b = std::sin(latitude_rad_), cos_b = std::cos(latitude_rad_);
  const double sin_l = std::sin(longitude_rad_), cos_l = std::cos(longitude_rad_);
  const double outward_m = cos_b * z_m - sin_b * y_m;  // in the plane of the datum's meridian
  const double x = origin_.x + cos_l * outward_m - sin_l * x_m;
  const double y = origin_.y + sin_l * outward_m + cos_l * x_m;
  const double z = origin_.z + sin_b * z_m + cos_b * y_m;
  const double across_m = std::hypot(x, y);
  // Bowring's parametric latitude, once: enough for heights of the ground.
  const double parametric = std::atan2(
      kPolarAxis_m * z * (1.0 + kSecondEccentricity2 * kPolarAxis_m / std::hypot(across_m, z)),
      kAxis_m * across_m);
  const double latitude_rad =
      std::atan2(z + kSecondEccentricity2 * kPolarAxis_m * std::pow(std::sin(parametric), 3),
                 across_m - kEccentricity2 * kAxis_m * std::pow(std::cos(parametric), 3));
  const double sine = std::sin(latitude_rad);
  return {.latitude_deg = deg(latitude_rad),
          .longitude_deg = deg(std::atan2(y, x)),
          .height_m = across_m * std::cos(latitude_rad) + z * sine -
                      kAxis_m * kAxis_m / prime_vertical_m(sine)};
}

// About z until x shows east, then about that until z shows up.
ros::Transform Ground::earth_to_map() const {
  const double about_z = 0.5 * (longitude_rad_ + kQuarterTurn);
  const double about_x = 0.5 * (kQuarterTurn - latitude_rad_);
  return {.translation = origin_,
          .rotation = {.x = std::cos(about_z) * std::sin(about_x),
                       .y = std::sin(about_z) * std::sin(about_x),
                       .z = std::sin(about_z) * std::cos(about_x),
                       .w = std::cos(about_z) * std::cos(about_x)}};
}

ros::Quaternion quaternion_of(double roll_rad, double pitch_rad, double yaw_rad) {
  const double cr = std::cos(0.5 * roll_rad), sr = std::sin(0.5 * roll_rad);
  const double cp = std::cos(0.5 * pitch_rad), sp = std::sin(0.5 * pitch_rad);
  const double cy = std::cos(0.5 * yaw_rad), sy = std::sin(0.5 * yaw_rad);
  return {.x = sr * cp * cy - cr * sp * sy,
          .y = cr * sp * cy + sr * cp * sy,
          .z = cr * cp * sy - sr * sp * cy,
          .w = cr * cp * cy + sr * sp * sy};
}

}  // namespace pitwall::publishers::ros_view
