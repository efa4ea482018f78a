// Held against GeographicLib, which localization uses.
// SPDX-License-Identifier: Apache-2.0
#include "vehicle/guardian/tangent_plane.hpp"

#include <gtest/gtest.h>

#include <GeographicLib/LocalCartesian.hpp>
#include <random>

namespace pitwall::guardian {
namespace {

TEST(TangentPlane, IsThatOfGeographicLibWithinAMicrometre) {
  std::mt19937_64 random{1};
  const auto within = [&random](double low, double high) {
    return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
  };
  for (int i = 0; i < 2000; ++i) {
    const Geodetic datum{within(-85.0, 85.0), within(-180.0, 180.0), within(-100.0, 3000.0)};
    const Geodetic place{datum.latitude_deg + within(-0.09, 0.09),
                         datum.longitude_deg + within(-0.09, 0.09), within(-100.0, 3000.0)};
    const GeographicLib::LocalCartesian plane{datum.latitude_deg, datum.longitude_deg,
                                              datum.height_m};
    double x_m = 0.0, y_m = 0.0, z_m = 0.0;
    plane.Forward(place.latitude_deg, place.longitude_deg, place.height_m, x_m, y_m, z_m);
    const PlanePoint own = to_plane(datum, place);
    ASSERT_NEAR(own.x_m, x_m, 1e-6) << i;
    ASSERT_NEAR(own.y_m, y_m, 1e-6) << i;
  }
}

TEST(TangentPlane, NothingComesOfNothing) {
  EXPECT_TRUE(std::isnan(to_plane({36.0, -115.0, 600.0}, {}).x_m));
  EXPECT_TRUE(std::isnan(to_plane({}, {36.0, -115.0, 600.0}).y_m));
}

}  // namespace
}  // namespace pitwall::guardian
