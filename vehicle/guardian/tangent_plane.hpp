// Conversion from WGS 84 to the tangent plane of the track, in closed form. The guardian has its
// own so that it does not depend on the geodesy library of localization.
//   in     the datum and a position: latitude and longitude in degrees, height above the ellipsoid
//          in m
//   out    metres east and north of the datum
//   invariants
//          from the ECEF coordinates of both points, turned by longitude and latitude of the datum:
//            east  = (N + h) cos(lat) sin(dlon)
//            north = cos(lat0) (z - z0) - sin(lat0) (p - p0),
//            p = (N + h) cos(lat) cos(dlon), z = (N (1 - e^2) + h) sin(lat)
//   errors none; exact except for rounding: below 1 um within 10 km of the datum (a test compares)
//   source EPSG Guidance Note 7-2, 4.1.1 and 4.1.2, "geocentric/topocentric conversions"
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "protocol/vocabulary/units.hpp"

namespace pitwall::guardian {

struct Geodetic {
  double latitude_deg = kUnset, longitude_deg = kUnset, height_m = kUnset;
};

struct PlanePoint {
  double x_m = kUnset, y_m = kUnset;  // east, north
};

inline PlanePoint to_plane(const Geodetic& datum, const Geodetic& position) {
  constexpr double kSemiMajor_m = 6'378'137.0, kFlattening = 1.0 / 298.257223563;
  constexpr double kE2 = kFlattening * (2.0 - kFlattening);
  struct Meridian {  // distance from the axis and from the equator
    double p_m, z_m;
  };
  const auto meridian = [](const Geodetic& g, double sine, double cosine) {
    const double n_m = kSemiMajor_m / std::sqrt(1.0 - kE2 * sine * sine);
    return Meridian{(n_m + g.height_m) * cosine, (n_m * (1.0 - kE2) + g.height_m) * sine};
  };
  const double lat_rad = from_deg(position.latitude_deg), lat0_rad = from_deg(datum.latitude_deg);
  const double turn_rad = from_deg(position.longitude_deg - datum.longitude_deg);
  const double sin0 = std::sin(lat0_rad), cos0 = std::cos(lat0_rad);
  const Meridian here = meridian(position, std::sin(lat_rad), std::cos(lat_rad));
  const Meridian zero = meridian(datum, sin0, cos0);
  return {here.p_m * std::sin(turn_rad),
          cos0 * (here.z_m - zero.z_m) - sin0 * (here.p_m * std::cos(turn_rad) - zero.p_m)};
}

}  // namespace pitwall::guardian
