// SPDX-License-Identifier: Apache-2.0
#include "protocol/vocabulary/units.hpp"

#include <gtest/gtest.h>

namespace pitwall {
namespace {

TEST(Units, EveryConversionHasItsInverse) {
  for (double x = -500.0; x <= 500.0; x += 12.5) {
    EXPECT_NEAR(to_kmh(from_kmh(x)), x, 1e-12);
    EXPECT_NEAR(to_mph(from_mph(x)), x, 1e-12);
    EXPECT_NEAR(to_deg(from_deg(x)), x, 1e-12);
    EXPECT_NEAR(to_rpm(from_rpm(x)), x, 1e-12);
  }
  EXPECT_NEAR(from_mph(153.0), 68.397, 1e-3);  // the paper's peak
}

TEST(WrapPi, KeepsTheAngleAndStaysInRange) {
  for (double turns = -50.0; turns <= 50.0; turns += 0.37) {
    const double angle_rad = turns * 2.0 * std::numbers::pi;
    const double wrapped_rad = wrap_pi(angle_rad);
    EXPECT_LE(std::abs(wrapped_rad), std::numbers::pi);
    EXPECT_NEAR(std::cos(wrapped_rad), std::cos(angle_rad), 1e-12);
    EXPECT_NEAR(std::sin(wrapped_rad), std::sin(angle_rad), 1e-12);
  }
}

TEST(WrapPi, IsNotANumberForWhatIsNotAnAngle) {
  EXPECT_TRUE(std::isnan(wrap_pi(kUnset)));
  EXPECT_TRUE(std::isnan(wrap_pi(std::numeric_limits<double>::infinity())));
}

}  // namespace
}  // namespace pitwall
