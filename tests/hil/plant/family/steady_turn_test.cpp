// Understeer as the handbook has it for a linear car, and as the yaw rate of the plant shows.
// SPDX-License-Identifier: Apache-2.0
#include "tests/hil/plant/family/steady_turn.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "hil/plant/plant.hpp"
#include "hil/plant/tyre.hpp"
#include "protocol/vocabulary/units.hpp"
#include "tests/hil/plant/family/car_family.hpp"
#include "tests/hil/plant/step.hpp"

namespace pitwall::plant {
namespace {

// Pacejka 1.3.3: m/L (b/C1 - a/C2), of axles; without load sensitivity the loads do not matter.
TEST(Understeer, IsThatOfTheLinearSingleTrack) {
  Params p;
  p.drivetrain.differential_nms_per_rad = 0.0;
  p.aero.front_lift_area_m2 = p.aero.rear_lift_area_m2 = 0.0;
  p.front.load_sensitivity = p.rear.load_sensitivity = 0.0;
  for (const double peak_rad : {0.08, 0.12, 0.18}) {
    p.front.peak_slip_angle_rad = peak_rad;
    const double front = lat_stiffness_n(p.front, 1.0, 1.0),
                 rear = lat_stiffness_n(p.rear, 1.0, 1.0);
    const double expected = (1.0 / front - 1.0 / rear) / kGravity_mps2;
    EXPECT_NEAR(understeer_of(p), expected, 5e-5) << peak_rad;
  }
}

// A circle of constant radius driven by the plant at its own throttle, at speeds of the recorded
// drive: the angle that it takes is the stated one.
TEST(Understeer, IsTheAngleThatACircleTakes) {
  for (std::uint64_t i = 0; i < 8; ++i) {
    const FamilyCar car = drawn_car(11, i);
    Params p = car.params;
    p.steering.quantum_rad = 0.0;
    const double k = car.traits.understeer_rad_per_mps2, length_m = car.traits.wheelbase_m;
    constexpr double kSpeed_mps = 20.0, kRadius_m = 160.0;
    State s = rolling(p, standing(p, 0.0, 0.0, 0.0), kSpeed_mps, 2);
    double integral = 0.0, angle_rad = 0.0;
    for (int n = 0; n < 8000; ++n) {
      const double wanted = s.motion.vx_mps / kRadius_m;
      const double error = wanted - s.motion.yaw_rate_rad_per_s;
      integral += error * kStep_s;
      angle_rad = length_m / kRadius_m + 0.05 * error + 0.5 * integral;
      const double throttle = 0.35 + 0.3 * (kSpeed_mps - s.motion.vx_mps);
      s = step(p, s,
               {.steering_motor_rad = p.steering.ratio * angle_rad,
                .throttle_fraction = throttle,
                .gear = 2,
                .ignition = true},
               {}, kStep_s);
    }
    const double ay_mps2 = s.motion.vx_mps * s.motion.yaw_rate_rad_per_s;
    const double is = (angle_rad - length_m / kRadius_m) / ay_mps2;
    EXPECT_NEAR(s.motion.yaw_rate_rad_per_s * kRadius_m, s.motion.vx_mps, 0.02);
    EXPECT_NEAR(is, k, std::max(0.05 * k, 5e-5)) << to_string(car);
  }
}

}  // namespace
}  // namespace pitwall::plant
