// Ground of a known track under a sweep: the banked road of the map, moved and tilted to fit.
//   in     points in Body; where our car is on the map
//   out    of a point: its place on the track and its height over the road
//   law    with an exact pose and attitude the map's road is the ground. The wheels stand on it:
//          height and attitude of Body come from the road; what springs and an error of the pose
//          add is a plane that is fitted to the points near the road
//   errors none: without enough points the plane stays level, `points` says how many there were
//   cost   O(points): 2 ms for 75,000
//   source fit by least squares on those within a band that narrows, 0.5 m to 0.1 m
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>

#include "vehicle/autonomy/perception/lidar/point_cloud.hpp"
#include "vehicle/autonomy/perception/lidar/track_grid.hpp"

namespace pitwall::perception {

struct BodyPose {
  double x_m = kUnset, y_m = kUnset, yaw_rad = kUnset;  // Map
  double over_road_m = 0.3;                             // of Body's origin
};

class TrackGround {
 public:
  // Unset where our car is beyond the walls.
  static std::optional<TrackGround> fit(const TrackGrid& grid, const BodyPose& pose,
                                        std::span<const LidarPoint> points);

  struct Point {
    TrackPlace place;
    double over_m = kUnset;
  };
  std::optional<Point> at(const LidarPoint& p) const;  // unset beyond the walls
  double ahead_m(const TrackPlace& place) const;       // along the track, from our car
  // Of the road below a place in Body, in Body.
  double height_m(double x_m, double y_m) const;
  // The road at a station ahead of our car and an offset, and its direction there, in Body.
  struct RoadInBody {
    double x_m, y_m, z_m, yaw_rad;
  };
  RoadInBody in_body(double ahead_m, double n_m) const;
  double yaw_rad(const TrackPlace& place) const { return place.yaw_rad - yaw_rad_; }
  std::size_t points() const { return points_; }

 private:
  explicit TrackGround(const TrackGrid& grid) : grid_(&grid) {}

  using Vector = std::array<double, 3>;
  double lifted_m(double x_m, double y_m) const {
    return plane_[0] + plane_[1] * x_m + plane_[2] * y_m;
  }

  const TrackGrid* grid_;
  std::array<Vector, 3> turn_{};  // rows: Body to Map
  Vector origin_{};
  Vector plane_{};  // over the map's road: 1, x, y of Body
  double s_m_ = 0.0, yaw_rad_ = 0.0;
  std::size_t points_ = 0;
};

}  // namespace pitwall::perception
