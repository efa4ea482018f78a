// SPDX-License-Identifier: Apache-2.0
#include "hil/sensors/geometry.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/hil/sensors/sensor_log.hpp"

namespace pitwall::sensors {
namespace {

TEST(Geometry, InMapIsARotation) {
  const plant::Truth t = standing_at(0, 0, 0.7, -0.3, 0.1);
  const Vector3 x = in_map({1, 0, 0}, t), y = in_map({0, 1, 0}, t), z = in_map({0, 0, 1}, t);
  const Vector3 third = cross(x, y);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(third[i], z[i], 1e-15);
  EXPECT_NEAR(std::hypot(x[0], x[1], x[2]), 1.0, 1e-15);
  EXPECT_NEAR(std::atan2(x[1], x[0]), 0.7, 1e-15);
  EXPECT_NEAR(x[2], -std::sin(0.1), 1e-15);  // nose down
  EXPECT_LT(y[2], 0.0);                      // left side down
}

TEST(Geometry, ACompassCountsFromNorthClockwise) {
  EXPECT_EQ(compass_rad(0.0, 1.0), 0.0);
  EXPECT_NEAR(compass_rad(1.0, 0.0), std::numbers::pi / 2.0, 1e-15);
  EXPECT_NEAR(compass_rad(-1.0, 0.0), 1.5 * std::numbers::pi, 1e-15);
}

}  // namespace
}  // namespace pitwall::sensors
