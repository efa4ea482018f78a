// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/perception/lidar/clusters/box_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "tests/support/draw.hpp"

namespace pitwall::perception {
namespace {

using Points = std::vector<PlanePoint>;

PlanePoint moved(const PlanePoint& p, double x_m, double y_m, double yaw_rad) {
  const double c = std::cos(yaw_rad), s = std::sin(yaw_rad);
  return {x_m + p.x_m * c - p.y_m * s, y_m + p.x_m * s + p.y_m * c};
}

// The rear and the right side of a car, as an L.
Points corner(double length_m, double width_m, double noise_m, std::uint32_t seed) {
  std::mt19937_64 random{seed};
  Points points;
  constexpr int kPoints = 20;
  for (int i = 0; i <= kPoints; ++i) {
    points.push_back({length_m * i / kPoints, testing::draw_normal(random, noise_m)});
    points.push_back({testing::draw_normal(random, noise_m), width_m * i / kPoints});
  }
  return points;
}

double quarter_apart(double a_rad, double b_rad) {
  return std::abs(std::remainder(a_rad - b_rad, 0.5 * std::numbers::pi));
}

TEST(BoxFit, FindsTheSidesOfACornerInAnyDirection) {
  for (int degrees = -180; degrees < 180; degrees += 7) {
    const double yaw_rad = degrees * std::numbers::pi / 180.0;
    Points points;
    for (const PlanePoint& p : corner(4.8, 1.8, 0.0, 1))
      points.push_back(moved(p, 30, -8, yaw_rad));
    const Rectangle fit = fit_rectangle(points);
    EXPECT_LT(quarter_apart(fit.yaw_rad, yaw_rad), 0.006) << degrees;
    EXPECT_NEAR(std::max(fit.along_m, fit.across_m), 4.8, 0.05) << degrees;
    EXPECT_NEAR(std::min(fit.along_m, fit.across_m), 1.8, 0.05) << degrees;
    const PlanePoint centre = moved({2.4, 0.9}, 30, -8, yaw_rad);
    EXPECT_NEAR(fit.x_m, centre.x_m, 0.05) << degrees;
    EXPECT_NEAR(fit.y_m, centre.y_m, 0.05) << degrees;
  }
}

TEST(BoxFit, NoiseOfALidarTurnsItByAFewDegreesAtMost) {
  for (std::uint32_t seed = 0; seed < 50; ++seed) {
    Points points;
    for (const PlanePoint& p : corner(4.8, 1.8, 0.03, seed)) points.push_back(moved(p, 0, 0, 0.3));
    EXPECT_LT(quarter_apart(fit_rectangle(points).yaw_rad, 0.3), 0.06) << seed;
  }
}

TEST(BoxFit, HoldsEveryPoint) {
  std::mt19937_64 random{4};
  const auto anywhere = [&] { return testing::draw_uniform(random, -5.0, 5.0); };
  for (int n = 2; n < 60; ++n) {
    Points points;
    for (int i = 0; i < n; ++i) points.push_back({anywhere(), anywhere()});
    const Rectangle fit = fit_rectangle(points);
    EXPECT_GE(fit.yaw_rad, 0.0);
    EXPECT_LT(fit.yaw_rad, 0.5 * std::numbers::pi);
    for (const PlanePoint& p : points) {
      const PlanePoint own = moved({p.x_m - fit.x_m, p.y_m - fit.y_m}, 0, 0, -fit.yaw_rad);
      EXPECT_LE(std::abs(own.x_m), 0.5 * fit.along_m + 1e-9);
      EXPECT_LE(std::abs(own.y_m), 0.5 * fit.across_m + 1e-9);
    }
  }
}

}  // namespace
}  // namespace pitwall::perception
