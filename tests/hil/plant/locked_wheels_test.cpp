// What a locked axle does to the car: with the front wheels locked it goes straight on whatever the
// steering says, with the rear wheels locked it swaps its ends. Gillespie, Fundamentals of Vehicle
// Dynamics, ch. 3 (wheel lockup); Milliken, Race Car Vehicle Dynamics, ch. 5 and 20.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "hil/plant/dynamics.hpp"
#include "hil/plant/plant.hpp"
#include "hil/plant/tyre.hpp"
#include "protocol/vocabulary/units.hpp"
#include "tests/hil/plant/step.hpp"

namespace pitwall::plant {
namespace {

constexpr double kFast_mps = 40.0, kSlow_mps = 5.0;
constexpr double kSteering_rad = 0.35;  // at the motor: 1 degree at the wheels
constexpr double kKick_rad_per_s = 0.02;

struct Slide {
  bool front_locked = false, rear_locked = false;
  double slip_deg = 0.0, yaw_deg = 0.0, course_deg = 0.0;  // largest, turned, turned
};

// Full pressure from 40 m/s on a level road until 5 m/s.
Slide slide(double front_remaining, double rear_remaining, double steering_rad) {
  Params p;
  p.brakes.front_remaining = front_remaining, p.brakes.rear_remaining = rear_remaining;
  State s = rolling(p, standing(p, 0.0, 0.0, 0.0), kFast_mps, 6);
  s.motion.yaw_rate_rad_per_s = kKick_rad_per_s;
  const Actuation a{.steering_motor_rad = steering_rad,
                    .brake_kpa = p.brakes.pressure_max_kpa,
                    .gear = 6,
                    .ignition = true};
  Slide out;
  for (int i = 0; i < 10000 && std::hypot(s.motion.vx_mps, s.motion.vy_mps) > kSlow_mps; ++i) {
    s = step(p, s, a, {}, kStep_s);
    out.front_locked = out.front_locked || (s.locked[0] && s.locked[1]);
    out.rear_locked = out.rear_locked || (s.locked[2] && s.locked[3]);
    const double slip_deg = to_deg(std::atan2(s.motion.vy_mps, s.motion.vx_mps));
    out.slip_deg = std::max(out.slip_deg, std::abs(slip_deg));
    out.yaw_deg = to_deg(s.motion.yaw_rad), out.course_deg = out.yaw_deg + slip_deg;
  }
  return out;
}

TEST(LockedWheels, TheFrontAxleGoesStraightOn) {
  const Slide free = slide(0.0, 0.0, kSteering_rad);
  EXPECT_GT(free.yaw_deg, 30.0);  // the same steering turns the car that rolls
  const Slide locked = slide(1.0, 0.0, kSteering_rad);
  EXPECT_TRUE(locked.front_locked);
  EXPECT_LT(locked.slip_deg, 2.0);
  EXPECT_LT(std::abs(locked.course_deg), 0.25 * free.yaw_deg);
}

TEST(LockedWheels, TheRearAxleSpinsTheCar) {
  const Slide locked = slide(0.0, 1.0, 0.0);
  EXPECT_TRUE(locked.rear_locked);
  EXPECT_GT(locked.slip_deg, 90.0);
}

TEST(LockedWheels, BothCircuitsLockTheFrontAxleFirst) {
  const Slide locked = slide(1.0, 1.0, 0.0);
  EXPECT_TRUE(locked.front_locked);
  EXPECT_LT(locked.slip_deg, 5.0);
}

// The friction of a wheel that does not turn points against its sliding, whatever its angle; not
// exactly, because these tyres have other friction along than across.
TEST(LockedWheels, SlideAgainstTheirVelocity) {
  constexpr double kLoad_n = 2000.0, kAside_rad = 0.14;
  const Params p;
  for (const Tyre& tyre : {p.front, p.rear}) {
    for (double angle_rad = -1.5; angle_rad <= 1.5; angle_rad += 0.1) {
      const double along_mps = 20.0 * std::cos(angle_rad), across_mps = 20.0 * std::sin(angle_rad);
      const double reference_mps =
          std::sqrt(0.5 * along_mps * along_mps + across_mps * across_mps);  // as of a patch
      const TyreForce f =
          tyre_force(tyre, {-along_mps / reference_mps, -across_mps / reference_mps}, kLoad_n, 1.0);
      const double against_rad = std::atan2(-f.lat_n, -f.long_n);
      EXPECT_NEAR(against_rad, angle_rad, kAside_rad) << angle_rad;
      EXPECT_LT(std::hypot(f.long_n, f.lat_n), std::max(tyre.mu_long, tyre.mu_lat) * kLoad_n);
      EXPECT_GT(std::hypot(f.long_n, f.lat_n), 0.5 * tyre.mu_long * kLoad_n);
    }
  }
}

}  // namespace
}  // namespace pitwall::plant
