// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/perception/lidar/track_ground.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <array>
#include <cmath>

namespace pitwall::perception {
namespace {

constexpr std::size_t kFitPoints = 6'000;  // so many of the sweep are enough
constexpr std::size_t kFitPointsLeast = 100;
constexpr double kFitReach_m = 60.0;  // further away the road sends little back
// Near points first: a tilt that lifts far ones out of the band is then mostly gone.
constexpr std::array kBands_m{0.5, 0.5, 0.25, 0.15, 0.1};

}  // namespace

std::optional<TrackGround> TrackGround::fit(const TrackGrid& grid, const BodyPose& pose,
                                            std::span<const LidarPoint> points) {
  using Eigen::AngleAxisd, Eigen::Vector3d;
  const auto ours = grid.at(pose.x_m, pose.y_m);
  if (!ours) return std::nullopt;
  TrackGround ground{grid};
  ground.s_m_ = ours->s_m, ground.yaw_rad_ = pose.yaw_rad;
  const Eigen::Matrix3d turn =
      (AngleAxisd(pose.yaw_rad, Vector3d::UnitZ()) * AngleAxisd(-ours->bank_rad, Vector3d::UnitX()))
          .toRotationMatrix();
  for (std::size_t k = 0; k < 3; ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    ground.turn_[k] = {turn(row, 0), turn(row, 1), turn(row, 2)};
  }
  ground.origin_ = {pose.x_m, pose.y_m, ours->height_m + pose.over_road_m};
  const std::size_t each = 1 + points.size() / kFitPoints;
  for (const double band_m : kBands_m) {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Vector3d right = Vector3d::Zero();
    std::size_t used = 0;
    for (std::size_t i = 0; i < points.size(); i += each) {
      const LidarPoint& p = points[i];
      const double range_m = std::hypot(p.x_m, p.y_m);
      if (!is_finite(p) || range_m > kFitReach_m) continue;
      const auto at = ground.at(p);
      if (!at || std::abs(at->over_m) > band_m) continue;
      const Vector3d row{1.0, p.x_m, p.y_m};
      // Most points are near; those far away tell more of the tilt.
      normal += range_m * row * row.transpose(), right += range_m * at->over_m * row, ++used;
    }
    ground.points_ = used;
    if (used < kFitPointsLeast) continue;
    const Vector3d change = normal.ldlt().solve(right);
    for (std::size_t k = 0; k < 3; ++k) ground.plane_[k] += change[static_cast<Eigen::Index>(k)];
  }
  return ground;
}

std::optional<TrackGround::Point> TrackGround::at(const LidarPoint& p) const {
  const double x_m = p.x_m, y_m = p.y_m, z_m = p.z_m;
  const auto in_map = [&](std::size_t k) {
    return turn_[k][0] * x_m + turn_[k][1] * y_m + turn_[k][2] * z_m + origin_[k];
  };
  const auto place = grid_->at(in_map(0), in_map(1));
  if (!place) return std::nullopt;
  return Point{*place, in_map(2) - place->height_m - lifted_m(x_m, y_m)};
}

double TrackGround::ahead_m(const TrackPlace& place) const {
  return std::remainder(place.s_m - s_m_, grid_->track().length_m());
}

double TrackGround::height_m(double x_m, double y_m) const {
  // Over the road the height grows by the cosine of the banking for each metre of Body's z: one
  // step from z = 0 and one more are exact to a millimetre.
  LidarPoint p{.x_m = static_cast<float>(x_m), .y_m = static_cast<float>(y_m)};
  for (int step = 0; step < 2; ++step) {
    const auto at = this->at(p);
    if (!at) return kUnset;
    p.z_m -= static_cast<float>(at->over_m);
  }
  return p.z_m;
}

TrackGround::RoadInBody TrackGround::in_body(double ahead_m, double n_m) const {
  const world::TrackPoint road = grid_->track().offset(s_m_ + ahead_m, n_m);
  const double height_m = grid_->track().road(road.s_m, n_m).height_m;
  RoadInBody in_body{.x_m = 0.0, .y_m = 0.0, .z_m = 0.0, .yaw_rad = road.yaw_rad - yaw_rad_};
  // How far the plane lifts the road there depends on the place: a second step is exact to 0.1 mm.
  for (int step = 0; step < 2; ++step) {
    const Vector apart{road.x_m - origin_[0], road.y_m - origin_[1],
                       height_m + lifted_m(in_body.x_m, in_body.y_m) - origin_[2]};
    const auto along = [&](std::size_t axis) {
      return turn_[0][axis] * apart[0] + turn_[1][axis] * apart[1] + turn_[2][axis] * apart[2];
    };
    in_body.x_m = along(0), in_body.y_m = along(1), in_body.z_m = along(2);
  }
  return in_body;
}

}  // namespace pitwall::perception
