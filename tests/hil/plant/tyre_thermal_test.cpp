// The law's shape and the balance of energy. That a real tyre follows it is not tested: nothing is
// published to compare with.
// SPDX-License-Identifier: Apache-2.0
#include "hil/plant/tyre_thermal.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "hil/plant/dynamics.hpp"
#include "hil/plant/plant.hpp"

namespace pitwall::plant {
namespace {

TEST(TyreThermal, GripIsWholeBetweenColdAndHotAndFallsToBothSides) {
  TyreThermal t;
  t.cold_grip_loss = 0.3, t.hot_grip_loss = 0.2;
  EXPECT_EQ(thermal_grip(t, t.working_c), 1.0);
  EXPECT_EQ(thermal_grip(t, t.hot_c), 1.0);
  EXPECT_NEAR(thermal_grip(t, t.ambient_c), 0.7, 1e-12);
  EXPECT_NEAR(thermal_grip(t, t.ambient_c - 30.0), 0.7, 1e-12);
  EXPECT_NEAR(thermal_grip(t, t.ruined_c), 0.8, 1e-12);
  EXPECT_NEAR(thermal_grip(t, t.ruined_c + 300.0), 0.8, 1e-12);
  double before = thermal_grip(t, -40.0);
  for (double c = -40.0; c < t.working_c; c += 0.5) {
    EXPECT_GE(thermal_grip(t, c), before);
    before = thermal_grip(t, c);
  }
  for (double c = t.hot_c; c < 400.0; c += 0.5)
    EXPECT_GE(thermal_grip(t, c), thermal_grip(t, c + 1));
  EXPECT_EQ(thermal_grip(TyreThermal{}, 25.0), 1.0);  // no loss given
  EXPECT_EQ(thermal_grip(TyreThermal{}, 200.0), 1.0);
}

TEST(TyreThermal, SettlesWhereHeatingIsCooling) {
  const TyreThermal t;
  for (const double friction_w : {0.0, 2000.0, 12000.0})
    for (const double speed_mps : {0.0, 60.0}) {
      const double settled_c =
          t.ambient_c + t.slip_heat_share * friction_w /
                            (t.cooling_w_per_k + t.cooling_w_per_k_per_mps * speed_mps);
      EXPECT_NEAR(warming_kps(t, settled_c, friction_w, speed_mps), 0.0, 1e-12);
      EXPECT_GT(warming_kps(t, settled_c - 1.0, friction_w, speed_mps), 0.0);
      EXPECT_LT(warming_kps(t, settled_c + 1.0, friction_w, speed_mps), 0.0);
    }
}

// A car that slides to rest on locked wheels: with all friction heat kept and no air, what its
// motion loses is what its tyres gain.
TEST(TyreThermal, TheTyresGainWhatTheMotionLoses) {
  Params p;
  p.aero = {.air_density_kgpm3 = 0.0};
  p.brakes.front_nm_per_kpa = p.brakes.rear_nm_per_kpa = 1.0;  // so that no wheel turns
  // What deflected tyres can hold: their friction times the deflection of a sliding patch.
  const double held_j =
      p.rear.mu_long * p.chassis.mass_kg * kGravity_mps2 * std::sqrt(2.0) * p.rear.relaxation_m;
  p.thermal.slip_heat_share = 1.0;
  p.thermal.cooling_w_per_k = p.thermal.cooling_w_per_k_per_mps = 0.0;
  for (const double vy_mps : {0.0, 12.0}) {
    State s = rolling(p, standing(p, 0, 0, 0), 25.0, 0);
    s.motion.vy_mps = vy_mps;
    s.motion.brake_front_kpa = s.motion.brake_rear_kpa = p.brakes.pressure_max_kpa;
    s.motion.wheel_rad_per_s = {};
    s.locked = {true, true, true, true};
    const double moving_j = 0.5 * p.chassis.mass_kg * (25.0 * 25.0 + vy_mps * vy_mps);
    const auto heat_j = [&] {
      double sum_j = 0.0;
      for (const double c : s.tyre_c)
        sum_j += p.thermal.heat_capacity_jpk * (c - p.thermal.working_c);
      return sum_j;
    };
    for (int i = 0; i < 6000; ++i) {
      s = step(p, s, {.brake_kpa = p.brakes.pressure_max_kpa}, {}, 0.001);
      const Motion& m = s.motion;
      const double left_j =
          0.5 * p.chassis.mass_kg * (m.vx_mps * m.vx_mps + m.vy_mps * m.vy_mps) +
          0.5 * p.chassis.yaw_inertia_kgm2 * m.yaw_rate_rad_per_s * m.yaw_rate_rad_per_s;
      ASSERT_NEAR(heat_j() + left_j, moving_j, held_j) << i;
    }
    EXPECT_NEAR(heat_j(), moving_j, held_j);
  }
}

TEST(TyreThermal, GripOfTheCarFollowsTheTemperatureWhereThatIsAsked) {
  Params p;
  p.thermal.cold_grip_loss = p.thermal.hot_grip_loss = 0.3;
  const auto grip = [&](double tyre_c) {
    State s = rolling(p, standing(p, 0, 0, 0), 30.0, 0);
    s.tyre_c.fill(tyre_c);
    double most = 0.0;
    for (int i = 0; i < 1500; ++i) {
      s = step(p, s, {.steering_motor_rad = 4.0}, {}, 0.001);
      most = std::max(most, std::abs(observe(p, s, {}).specific_force_mps2[1]));
    }
    return most;
  };
  EXPECT_LT(grip(25.0), 0.8 * grip(90.0));
  EXPECT_LT(grip(170.0), 0.8 * grip(90.0));
}

TEST(TyreThermal, ReportsCanSayThatItIsUnvalidated) {
  EXPECT_NE(std::string{kTyreThermalCaveat}.find("unvalidated"), std::string::npos);
}

}  // namespace
}  // namespace pitwall::plant
