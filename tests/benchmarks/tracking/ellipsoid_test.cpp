// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/tracking/ellipsoid.hpp"

#include <gtest/gtest.h>

#include "protocol/vocabulary/units.hpp"

namespace pitwall::tracking_bench {
namespace {

// By numpy.linalg.solve.
TEST(Ellipsoid, IsTheDistanceThatNumpyHas) {
  const std::array<double, 16> p{4, 1, .2, .1, 1, 3, .3, -.4, .2, .3, .5, .05, .1, -.4, .05, 2.0};
  EXPECT_NEAR(squared_distance<4>({1.0, -2.0, 0.3, 1.5}, p), 3.1037695633639846, 1e-12);
}

TEST(Ellipsoid, HasNoneWhereTheCovarianceIsNotPositive) {
  EXPECT_TRUE(std::isinf(squared_distance<2>({1.0, 1.0}, {1.0, 2.0, 2.0, 1.0})));
  EXPECT_TRUE(std::isinf(squared_distance<2>({1.0, 1.0}, {0.0, 0.0, 0.0, 1.0})));
  EXPECT_TRUE(std::isinf(squared_distance<1>({1.0}, {kUnset})));
}

}  // namespace
}  // namespace pitwall::tracking_bench
