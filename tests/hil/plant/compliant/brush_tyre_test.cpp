// The closed forms against the bristles themselves, added up one by one; what friction and load do.
// SPDX-License-Identifier: Apache-2.0
#include "hil/plant/compliant/brush_tyre.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "protocol/vocabulary/random.hpp"

namespace pitwall::plant {
namespace {

struct Bristles {
  double force_n = 0.0, moment_nm = 0.0;  // about the middle of the patch
};

// Pacejka 3.2.1: from the leading edge on a bristle is bent by slip times its way, and holds no
// more than friction times the parabolic pressure.
Bristles added_up(double stiffness_n, double half_m, double friction, double load_n, double slip) {
  constexpr int kBristles = 200'000;
  const double per_m2 = stiffness_n / (2.0 * half_m * half_m);
  Bristles sum;
  for (int i = 0; i < kBristles; ++i) {
    const double x_m = half_m * (2.0 * (i + 0.5) / kBristles - 1.0);
    const double pressure = 0.75 * load_n / half_m * (1.0 - x_m * x_m / (half_m * half_m));
    const double q = std::min(per_m2 * (half_m - x_m) * slip, friction * pressure);
    sum.force_n += q * 2.0 * half_m / kBristles;
    sum.moment_nm += q * x_m * 2.0 * half_m / kBristles;
  }
  return sum;
}

Tyre even_tyre() {
  Tyre tyre;
  tyre.mu_long = tyre.mu_lat = 1.2;
  tyre.peak_slip_angle_rad = std::asin(tyre.peak_slip_ratio);
  return tyre;
}

TEST(BrushTyre, IsTheSumOfItsBristles) {
  const Tyre tyre = even_tyre();
  const Brush brush{.sliding_friction = 1.0};
  Random random{4};
  for (int i = 0; i < 60; ++i) {
    const double load_n = random.between(300.0, 6000.0), grip = random.between(0.3, 1.2);
    const double slip = random.between(0.0, 0.15), way = random.between(-3.0, 3.0);
    const TyreSlip both{slip * std::cos(way), slip * std::sin(way)};
    // The trail at rest is a third of the half patch.
    const double half_m = 3.0 * brush.trail_m * std::sqrt(load_n / tyre.nominal_load_n);
    const double friction = lat_limit_n(tyre, load_n, grip) / load_n;
    const Bristles is =
        added_up(brush_lat_stiffness_n(tyre, brush, load_n), half_m, friction, load_n, slip);
    const TyreForce force = brush_force(tyre, brush, both, load_n, grip);
    const double trail_m = pneumatic_trail_m(tyre, brush, both, load_n, grip);
    EXPECT_NEAR(std::hypot(force.long_n, force.lat_n), is.force_n, 1e-6 * load_n);
    EXPECT_NEAR(std::atan2(force.lat_n, force.long_n), way, 1e-9);
    EXPECT_NEAR(trail_m * is.force_n, -is.moment_nm, 1e-6 * load_n * half_m);
  }
}

TEST(BrushTyre, PeakIsTheLimitAndFallsToSliding) {
  const Tyre tyre = Params{}.rear;
  const Brush brush;
  for (const double load_n : {500.0, 2200.0, 5000.0})
    for (const double grip : {0.4, 1.0}) {
      double along_n = 0.0, across_n = 0.0;
      for (double slip = 0.0; slip < 0.5; slip += 1e-4) {
        along_n = std::max(along_n, brush_force(tyre, brush, {slip, 0.0}, load_n, grip).long_n);
        across_n = std::max(across_n, brush_force(tyre, brush, {0.0, slip}, load_n, grip).lat_n);
      }
      const double along_most_n = long_limit_n(tyre, load_n, grip);
      const double across_most_n = lat_limit_n(tyre, load_n, grip);
      EXPECT_NEAR(along_n, along_most_n, 1e-4 * along_most_n);
      EXPECT_NEAR(across_n, across_most_n, 1e-4 * across_most_n);
      EXPECT_NEAR(brush_force(tyre, brush, {1e4, 0.0}, load_n, grip).long_n,
                  brush.sliding_friction * along_most_n, 1e-3 * along_most_n);
    }
}

// What the magic formula of the double track does not do.
TEST(BrushTyre, FrictionMovesThePeakAndNotTheStiffness) {
  const Tyre tyre = Params{}.front;
  const Brush brush;
  constexpr double kLoad_n = 1700.0, kSlip = 1e-6;
  for (const double grip : {0.3, 0.7, 1.0}) {
    const TyreForce little = brush_force(tyre, brush, {0.0, kSlip}, kLoad_n, grip);
    EXPECT_NEAR(little.lat_n / kSlip, brush_lat_stiffness_n(tyre, brush, kLoad_n),
                1e-3 * little.lat_n / kSlip);
    const double peak = grip * std::sin(tyre.peak_slip_angle_rad);
    EXPECT_LT(brush_force(tyre, brush, {0.0, 0.99 * peak}, kLoad_n, grip).use, 1.0);
    EXPECT_EQ(brush_force(tyre, brush, {0.0, 1.01 * peak}, kLoad_n, grip).use, 1.0);
  }
}

TEST(BrushTyre, IsStiffestAtTheStatedLoad) {
  const Tyre tyre = Params{}.front;
  const Brush brush;
  const double stiffest_n = brush.stiffest_load * tyre.nominal_load_n;
  const double most = brush_lat_stiffness_n(tyre, brush, stiffest_n);
  EXPECT_GT(most, brush_lat_stiffness_n(tyre, brush, 0.9 * stiffest_n));
  EXPECT_GT(most, brush_lat_stiffness_n(tyre, brush, 1.1 * stiffest_n));
  // Pacejka 4.3.2, written with its arc tangent.
  for (const double load_n : {400.0, 1700.0, 4000.0}) {
    const auto shape = [&](double n) { return std::sin(2.0 * std::atan(n / stiffest_n)); };
    EXPECT_NEAR(brush_long_stiffness_n(tyre, brush, load_n),
                3.0 * tyre.mu_long * tyre.nominal_load_n / tyre.peak_slip_ratio * shape(load_n) /
                    shape(tyre.nominal_load_n),
                1e-6);
  }
}

TEST(BrushTyre, WithoutLoadOrFrictionThereIsNoForce) {
  const Tyre tyre = Params{}.front;
  const Brush brush;
  for (const double slip : {0.0, 0.05, 3.0}) {
    const TyreForce light = brush_force(tyre, brush, {slip, slip}, 0.0, 1.0);
    const TyreForce ice = brush_force(tyre, brush, {slip, slip}, 2000.0, 0.0);
    EXPECT_EQ(light.long_n, 0.0);
    EXPECT_EQ(light.lat_n, 0.0);
    EXPECT_EQ(ice.long_n, 0.0);
    EXPECT_EQ(ice.lat_n, 0.0);
    EXPECT_TRUE(std::isfinite(pneumatic_trail_m(tyre, brush, {slip, slip}, 0.0, 1.0)));
  }
}

}  // namespace
}  // namespace pitwall::plant
