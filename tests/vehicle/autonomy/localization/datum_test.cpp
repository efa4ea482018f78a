// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/localization/datum.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "protocol/vocabulary/units.hpp"

namespace pitwall::localization {
namespace {

TEST(Datum, AgreesWithTheRadiiOfCurvatureOfTheEllipsoid) {
  // Oracle: M = a (1 - e2) / w^3 and N = a / w with w^2 = 1 - e2 sin^2, WGS 84.
  constexpr double kA_m = 6378137.0, kE2 = 6.69437999014e-3, kSmall_deg = 1e-4;
  for (const double lat : {-45.0, 0.0, 36.27, 60.0}) {
    const auto datum = Datum::at(lat, -115.0, 600.0);
    ASSERT_TRUE(datum);
    const double w = std::sqrt(1.0 - kE2 * std::pow(std::sin(from_deg(lat)), 2));
    const double m = kA_m * (1.0 - kE2) / (w * w * w) + 600.0, n = kA_m / w + 600.0;
    const auto north = datum->to_map(lat + kSmall_deg, -115.0, 600.0).value();
    const auto east = datum->to_map(lat, -115.0 + kSmall_deg, 600.0).value();
    EXPECT_NEAR(north.y_m, m * from_deg(kSmall_deg), 1e-4) << lat;
    EXPECT_NEAR(north.x_m, 0.0, 1e-9);
    EXPECT_NEAR(east.x_m, n * std::cos(from_deg(lat)) * from_deg(kSmall_deg), 1e-4) << lat;
    EXPECT_NEAR(datum->to_map(lat, -115.0, 605.0)->z_m, 5.0, 1e-9);
    EXPECT_NEAR(datum->to_map(lat, -115.0, kUnset)->z_m, 0.0, 1e-9);
  }
}

TEST(Datum, RefusesPlacesThatAreNotOnTheEarth) {
  EXPECT_FALSE(Datum::at(91.0, 0.0, 0.0));
  EXPECT_FALSE(Datum::at(0.0, 181.0, 0.0));
  EXPECT_FALSE(Datum::at(kUnset, 0.0, 0.0));
  EXPECT_FALSE(Datum::at(0.0, 0.0, kUnset));
  const auto datum = Datum::at(36.0, -115.0, 0.0);
  ASSERT_TRUE(datum);
  for (const double bad : {kUnset, 1.0 / 0.0, 500.0}) {
    EXPECT_FALSE(datum->to_map(bad, 0.0, 0.0));
    EXPECT_FALSE(datum->to_map(0.0, bad, 0.0));
  }
}

}  // namespace
}  // namespace pitwall::localization
