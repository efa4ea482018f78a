// Roll as an oscillator, understeer by compliance as the handbook has it, brakes with a gap.
// SPDX-License-Identifier: Apache-2.0
#include "hil/plant/compliant/flexible_chassis.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "hil/plant/compliant/brush_tyre.hpp"
#include "tests/hil/plant/rolling_car.hpp"
#include "tests/hil/plant/step.hpp"

namespace pitwall::plant {
namespace {

Params compliant() {
  Params p;
  p.structure = Structure::kCompliantBrush;
  return p;
}

// Let go from a lean: frequency and decay of a damped oscillator.
TEST(FlexibleChassis, RollsAsADampedOscillator) {
  const Params p = compliant();
  const Suspension& s = p.suspension;
  const double stiffness = s.front_nm_per_rad + s.rear_nm_per_rad;
  const double damping = s.front_nms_per_rad + s.rear_nms_per_rad;
  const double decay = 0.5 * damping / s.roll_inertia_kgm2;
  const double swing = std::sqrt(stiffness / s.roll_inertia_kgm2 - decay * decay);
  State car = rolling_car(0.0, 0, p);
  constexpr double kLean_rad = 1e-4;
  car.motion.roll_rad = kLean_rad;
  for (int i = 1; i <= 300; ++i) {
    car = step(p, car, {}, {}, kStep_s);
    const double t = i * kStep_s;
    const double expected = kLean_rad * std::exp(-decay * t) *
                            (std::cos(swing * t) + decay / swing * std::sin(swing * t));
    ASSERT_NEAR(car.motion.roll_rad, expected, 1e-3 * kLean_rad) << i;
  }
}

TEST(FlexibleChassis, LeansOutOfTheTurnAndSettles) {
  const Params p = compliant();
  State s = rolling_car(30.0, 0, p);
  for (int i = 0; i < 3000; ++i) {
    s = step(p, s, {.steering_motor_rad = 0.5}, {}, kStep_s);
    s.motion.vx_mps = 30.0;
  }
  const Truth t = observe(p, s, {});
  EXPECT_GT(t.specific_force_mps2[1], 3.0);
  EXPECT_GT(s.motion.roll_rad, 0.0);
  EXPECT_NEAR(s.motion.roll_rad, settled_roll_rad(p, mass_kg(p, s), t.specific_force_mps2[1]),
              1e-3 * s.motion.roll_rad);
  EXPECT_GT(t.load_n[1], t.load_n[0]);
}

// Steady turn, few m/s2: the flex is compliance times lateral force times trail.
TEST(FlexibleChassis, SteeringYieldsToItsTyres) {
  const Params p = compliant();
  State s = rolling_car(20.0, 0, p);
  for (int i = 0; i < 2000; ++i) {
    s = step(p, s, {.steering_motor_rad = 0.05}, {}, kStep_s);
    s.motion.vx_mps = 20.0;
  }
  const Truth t = observe(p, s, {});
  double moment_nm = 0.0;
  for (std::size_t i = 0; i < 2; ++i)
    moment_nm +=
        t.force_lat_n[i] * p.brush.trail_m * std::sqrt(t.load_n[i] / p.front.nominal_load_n);
  EXPECT_GT(t.force_lat_n[0], 0.0);
  EXPECT_LT(s.motion.steering_flex_rad, 0.0);
  EXPECT_NEAR(s.motion.steering_flex_rad, -p.compliance.rad_per_nm * moment_nm,
              0.1 * p.compliance.rad_per_nm * moment_nm);  // the trail shrinks with slip
  EXPECT_EQ(t.road_wheel_rad, t.steering_motor_rad / p.steering.ratio + s.motion.steering_flex_rad);
}

TEST(FlexibleChassis, PadsHaveAGapAndLetGoSlowly) {
  Params p = compliant();
  p.brakes.delay_s = 0.0;
  const double gap_kpa = p.hydraulics.dead_band_kpa;
  EXPECT_EQ(pressing_kpa(p, gap_kpa), 0.0);
  EXPECT_EQ(pressing_kpa(p, gap_kpa + 100.0), 100.0);
  State s = rolling_car(30.0, 0, p);
  const auto hold_nm = [&] { return forces_of(p, s, s.motion, {}).hold_nm[0]; };
  const double free_nm = hold_nm();
  for (int i = 0; i < 1000; ++i) s = step(p, s, {.brake_kpa = 0.99 * gap_kpa}, {}, kStep_s);
  EXPECT_NEAR(hold_nm(), free_nm, 0.05 * free_nm);
  const auto rise_to = [&](double kpa) {
    int steps = 0;
    const double from_kpa = s.motion.brake_front_kpa;
    while (std::abs(s.motion.brake_front_kpa - kpa) > std::exp(-1.0) * std::abs(from_kpa - kpa))
      s = step(p, s, {.brake_kpa = kpa}, {}, kStep_s), ++steps;
    return steps * kStep_s;
  };
  EXPECT_NEAR(rise_to(2000.0), p.brakes.lag_s, 2.0 * kStep_s);
  EXPECT_NEAR(rise_to(0.0), p.hydraulics.release_lag_s, 2.0 * kStep_s);
}

}  // namespace
}  // namespace pitwall::plant
