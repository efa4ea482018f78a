// Position of Map on the Earth: latitude and longitude of its points, and the transform from the
// frame `earth` to the frame `map`.
//   in     the datum of a track, at which Map has its origin: WGS 84, height above the ellipsoid
//   frames Map: x east, y north, z up (REP 103); earth: REP 105, geocentric, x to longitude 0 at
//          the equator, z to the north pole
//   cost   some trigonometry
//   source NGA.STND.0036 (WGS 84); Bowring 1985, the accuracy of geodetic latitude and height
//          equations: below a micrometre near the ground
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "protocol/ros/messages/geometry.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::publishers::ros_view {

struct Geodetic {
  double latitude_deg = kUnset, longitude_deg = kUnset, height_m = kUnset;
};

class Ground {
 public:
  explicit Ground(const Geodetic& datum);

  Geodetic at(double x_m, double y_m, double z_m) const;
  ros::Transform earth_to_map() const;

 private:
  double latitude_rad_, longitude_rad_;
  ros::Vector3 origin_;  // geocentric
};

// Rotations about x, then y, then z, as roll, pitch and yaw in ISO 8855 and REP 103.
ros::Quaternion quaternion_of(double roll_rad, double pitch_rad, double yaw_rad);

}  // namespace pitwall::publishers::ros_view
