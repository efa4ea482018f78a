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

}  // namespace
}  // namespace pitwall::envelope
