// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/control/bicycle_model.hpp"

#include <gtest/gtest.h>

#include "tests/vehicle/autonomy/control/single_track.hpp"

namespace pitwall::control {
namespace {

// Forces of a linear single-track car, written from Newton's law in body coordinates: an oracle
// that does not know the error model.
struct BodyRates {
  double vy, r;
};
BodyRates newton(const BicycleParams& c, double v, double vy, double r, double angle) {
  const double slip_f = angle - (vy + c.cg_to_front_m * r) / v;
  const double slip_r = -(vy - c.cg_to_rear_m * r) / v;
  const double ff = c.cornering_front_n_per_rad * slip_f, fr = c.cornering_rear_n_per_rad * slip_r;
  return {(ff + fr) / c.mass_kg - v * r,
          (c.cg_to_front_m * ff - c.cg_to_rear_m * fr) / c.yaw_inertia_kg_m2};
}

TEST(BicycleModel, AgreesWithNewtonOnAStraightPath) {
  // On a straight path and for small angles e1' = vy + v e2 and e2' = r.
  const BicycleParams car = testing::recommended().bicycle;
  for (const double v : {5.0, 22.5, 65.0}) {
    for (const double e2 : {-0.02, 0.0, 0.03}) {
      const double vy = 0.3, r = -0.1, angle = 0.01;
      const ErrorVector e{0.4, vy + v * e2, e2, r};
      const ErrorVector rate = error_dynamics(car, v) * e + steering_input(car) * angle;
      const BodyRates body = newton(car, v, vy, r, angle);
      EXPECT_NEAR(rate[0], e[1], 1e-12);
      EXPECT_NEAR(rate[1], body.vy + v * r, 1e-9);
      EXPECT_NEAR(rate[2], r, 1e-12);
      EXPECT_NEAR(rate[3], body.r, 1e-9);
    }
  }
}

TEST(BicycleModel, SlidesAlongThePathWithoutCost) {
  // Where along the lateral axis the path lies does not matter to the car.
  const Eigen::Matrix4d a = error_dynamics(testing::recommended().bicycle, 30.0);
  EXPECT_TRUE(a.col(0).isZero(0.0));
}

}  // namespace
}  // namespace pitwall::control
