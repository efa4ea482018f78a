// SPDX-License-Identifier: Apache-2.0
#include "hil/plant/tyre.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace pitwall::plant {
namespace {

const Tyre kTyre = Params{}.rear;

TEST(Tyre, IsOddInSlip) {
  for (const double ratio : {0.0, 0.003, 0.05, 0.4})
    for (const double sine : {0.0, 0.01, 0.2}) {
      const auto f = tyre_force(kTyre, {ratio, sine}, 3000.0, 1.0);
      const auto g = tyre_force(kTyre, {-ratio, -sine}, 3000.0, 1.0);
      EXPECT_EQ(f.long_n, -g.long_n);
      EXPECT_EQ(f.lat_n, -g.lat_n);
    }
}

TEST(Tyre, StartsWithItsStiffness) {
  constexpr double kSmall = 1e-6;
  const auto f = tyre_force(kTyre, {kSmall, 0.0}, 3000.0, 0.9);
  const auto g = tyre_force(kTyre, {0.0, kSmall}, 3000.0, 0.9);
  EXPECT_NEAR(f.long_n / kSmall / long_stiffness_n(kTyre, 3000.0, 0.9), 1.0, 1e-6);
  EXPECT_NEAR(g.lat_n / kSmall / lat_stiffness_n(kTyre, 3000.0, 0.9), 1.0, 1e-6);
}

TEST(Tyre, PeaksWhereItIsTold) {
  const double peak = kTyre.peak_slip_angle_rad;
  const auto lat_n = [](double angle_rad) {
    return tyre_force(kTyre, {0.0, std::sin(angle_rad)}, kTyre.nominal_load_n, 1.0).lat_n;
  };
  EXPECT_NEAR(lat_n(peak), kTyre.mu_lat * kTyre.nominal_load_n, 1e-9);
  for (double a = 0.0; a < 1.0; a += 0.01) EXPECT_LE(lat_n(a), lat_n(peak) + 1e-9);
}

// Friction ellipse: no combination of slips gives more than either axis allows.
TEST(Tyre, CombinedForceStaysInsideTheEllipse) {
  const double load_n = kTyre.nominal_load_n;
  for (double ratio = -1.0; ratio <= 1.0; ratio += 0.03)
    for (double sine = -0.9; sine <= 0.9; sine += 0.03) {
      const auto f = tyre_force(kTyre, {ratio, sine}, load_n, 1.0);
      const double share =
          std::hypot(f.long_n / (kTyre.mu_long * load_n), f.lat_n / (kTyre.mu_lat * load_n));
      EXPECT_LE(share, 1.0 + 1e-12);
      EXPECT_GE(f.use, share - 1e-12);
      EXPECT_LE(f.use, 1.0);
    }
}

TEST(Tyre, LongitudinalSlipTakesFromTheLateralForce) {
  const double alone_n = tyre_force(kTyre, {0.0, 0.04}, 3000.0, 1.0).lat_n;
  const double braking_n = tyre_force(kTyre, {-0.3, 0.04}, 3000.0, 1.0).lat_n;
  EXPECT_LT(braking_n, 0.5 * alone_n);
  EXPECT_GT(braking_n, 0.0);
}

TEST(Tyre, GripPerLoadFallsWithLoad) {
  const auto mu = [](double load_n) {
    return tyre_force(kTyre, {0.0, std::sin(kTyre.peak_slip_angle_rad)}, load_n, 1.0).lat_n /
           load_n;
  };
  EXPECT_GT(mu(1000.0), mu(2200.0));
  EXPECT_GT(mu(2200.0), mu(5000.0));
  EXPECT_GE(mu(1e6), kTyre.mu_min_share * kTyre.mu_lat - 1e-12);
  EXPECT_EQ(tyre_force(kTyre, {0.1, 0.1}, 0.0, 1.0).lat_n, 0.0);
}

}  // namespace
}  // namespace pitwall::plant
