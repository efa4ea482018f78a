// SPDX-License-Identifier: Apache-2.0
#include "vehicle/envelope/friction.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/vehicle/envelope/car.hpp"

namespace pitwall::envelope {
namespace {

const FrictionParams kCar = testing::av21();

TEST(Friction, EllipseIsNeverLeft) {
  for (double v = 0.0; v < 90.0; v += 2.5) {
    const RoadLoad at{v, 1.0 / 220.0, from_deg(20.0)};
    const double brake = brake_available_mps2(kCar, at, 0.7);
    const double grip = 0.7 * grip_mps2(kCar, at), lateral = lateral_demand_mps2(at);
    EXPECT_GE(brake, 0.0);
    if (brake > 0.0) {
      EXPECT_LE(std::hypot(brake, lateral), grip * (1.0 + 1e-12)) << v;
    }
    EXPECT_LE(drive_available_mps2(kCar, at, 0.7), kCar.accel_max_mps2);
  }
}

// By the balance of the driven axle: m r ((1 - l) n + h d) = d; sticky tyres under a high car gain
// load faster than they need it, and power alone is the limit.
TEST(Friction, TheRearAxleAloneDrives) {
  FrictionParams car = kCar;
  car.engine = testing::av21_engine();
  car.accel_max_mps2 = 50.0, car.power_w_per_kg = 1e5;
  for (double& torque_nm : car.engine.torque_nm) torque_nm *= 10.0;
  const RoadLoad at{15.0, 0.0, 0.0};
  const double load = normal_load_mps2(at, car.downforce_per_m);
  const double drag = car.drag_per_m * at.speed_mps * at.speed_mps;
  for (const double friction : {0.6, 1.0, 1.3}) {
    car.friction = friction;
    const double m = 0.8 * friction * car.long_friction;
    const double d = drive_available_mps2(car, at, 0.8) + drag;
    EXPECT_NEAR(m * ((1.0 - car.load_front) * load + car.load_shift * d), d, 1e-9) << friction;
  }
  car.friction = 2.5, car.long_friction = 1.5, car.load_shift = 0.4;
  EXPECT_GT(drive_available_mps2(car, at, 1.0), 5.0);
}

// By bisection over the speeds, on roads that turn with their bank, against it and not at all.
TEST(Friction, ACornerCarriesTheCarUpToItsSpeedAndNoFaster) {
  constexpr double kUsed = 0.8, kMost_mps = 90.0;
  for (const double radius_m : {60.0, -150.0, 250.0, -400.0, 1e9})
    for (const double bank_deg : {-20.0, -3.0, 0.0, 5.0, 24.0}) {
      const auto spare_mps2 = [&](double speed_mps) {
        const RoadLoad at{speed_mps, 1.0 / radius_m, from_deg(bank_deg)};
        return kUsed * grip_mps2(kCar, at) - std::abs(lateral_demand_mps2(at));
      };
      const RoadLoad road{kUnset, 1.0 / radius_m, from_deg(bank_deg)};
      const double carried = carried_mps(kCar, road, kUsed, kMost_mps);
      ASSERT_GT(carried, 0.0) << radius_m << " " << bank_deg;
      EXPECT_GE(spare_mps2(carried), -1e-9) << radius_m << " " << bank_deg;
      if (carried == kMost_mps) continue;
      EXPECT_NEAR(spare_mps2(carried), 0.0, 1e-9) << radius_m << " " << bank_deg;
      EXPECT_LT(spare_mps2(carried + 0.01), 0.0) << radius_m << " " << bank_deg;
    }
  const RoadLoad beyond{kUnset, 1.0 / 30.0, from_deg(-60.0)};
  EXPECT_EQ(carried_mps(kCar, beyond, kUsed, kMost_mps), 0.0);
}

}  // namespace
}  // namespace pitwall::envelope
