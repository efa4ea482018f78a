// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/perception/lidar/surface.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <random>

#include "tests/support/draw.hpp"

namespace pitwall::perception {
namespace {

// Rays 0.14 degrees apart that go `range_m` and some noise, across the x axis.
PointCloud rays(double range_m, double noise_m, std::uint32_t seed) {
  std::mt19937_64 random{seed};
  PointCloud points;
  for (int k = 0; k < 60; ++k) {
    const double angle_rad = 0.00244 * k, at_m = range_m + testing::draw_normal(random, noise_m);
    points.push_back({static_cast<float>(at_m * std::cos(angle_rad)),
                      static_cast<float>(at_m * std::sin(angle_rad)), 0.5F});
  }
  return points;
}

std::size_t on_surface(const PointCloud& points) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < points.size(); ++i) count += has_surface(points, i);
  return count;
}

TEST(Surface, IsSeenAtAnyRangeInSpiteOfTheNoise) {
  for (const double range_m : {3.0, 20.0, 60.0, 120.0})
    EXPECT_EQ(on_surface(rays(range_m, 0.025, 1)), 60U) << range_m;
}

TEST(Surface, OfDustIsSeldomSeen) {
  for (const double range_m : {10.0, 40.0})
    EXPECT_LT(on_surface(rays(range_m, 1.5, 2)), 20U) << range_m;
}

TEST(Surface, APointAloneHasNone) {
  EXPECT_FALSE(has_surface(PointCloud{{1.0F, 0.0F, 0.0F}}, 0));
  const PointCloud three{{9.0F, 0.0F, 0.0F}, {9.05F, 0.0F, 0.0F}, {30.0F, 0.0F, 0.0F}};
  EXPECT_TRUE(has_surface(three, 0)) << "the one after it";
  EXPECT_TRUE(has_surface(three, 1)) << "the one before it";
  EXPECT_FALSE(has_surface(three, 2));
}

}  // namespace
}  // namespace pitwall::perception
