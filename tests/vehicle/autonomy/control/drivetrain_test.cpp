// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/control/drivetrain.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "hil/plant/engine.hpp"
#include "hil/plant/params.hpp"
#include "tests/vehicle/envelope/car.hpp"

namespace pitwall::control {
namespace {

DrivetrainParams av21() {
  DrivetrainParams p{.car = envelope::testing::av21(),
                     .brake_kpa_per_mps2 = 350.0,
                     .rolling_mps2 = 0.13,
                     .dead_zone_mps2 = 0.3};
  p.car.engine = envelope::testing::av21_engine();
  return p;
}

// Acceleration of the modelled car in a gear, by its own equations: engine, drag, rolling.
double plant_mps2(const plant::Params& p, const Motion& m, double throttle) {
  const double ratio = p.drivetrain.final_drive * p.drivetrain.gear[m.gear - 1U];
  const double rpm = to_rpm(m.speed_mps / p.rear.radius_m * ratio);
  const double force_n = plant::engine_torque_nm(p.engine, rpm, throttle) * ratio *
                         p.drivetrain.efficiency / p.rear.radius_m;
  const double v2 = m.speed_mps * m.speed_mps;
  const double down_n =
      0.5 * p.aero.air_density_kgpm3 * (p.aero.front_lift_area_m2 + p.aero.rear_lift_area_m2) * v2;
  const double drag_n = 0.5 * p.aero.air_density_kgpm3 * p.aero.drag_area_m2 * v2;
  const double rolling_n = p.rear.rolling_resistance * (p.chassis.mass_kg * kGravity_mps2 + down_n);
  return (force_n - drag_n - rolling_n) / p.chassis.mass_kg;
}

// Half of the largest change of a share between two rows of the car file is 0.06 of 480 Nm
// (throttle_test.cpp): 29 Nm, in second gear 0.65 m/s2, in fifth 0.33.
TEST(Drivetrain, TheThrottleGivesTheAccelerationInTheModelledCar) {
  const DrivetrainParams p = av21();
  const plant::Params plant;
  for (const auto& [speed_mps, gear, bound_mps2] : {std::tuple{25.0, 2, 0.65},
                                                    {30.0, 2, 0.65},
                                                    {40.0, 3, 0.48},
                                                    {50.0, 4, 0.39},
                                                    {62.0, 5, 0.33},
                                                    {66.0, 6, 0.31}}) {
    const Motion m{.speed_mps = speed_mps, .gear = static_cast<std::uint8_t>(gear)};
    for (double a = 0.0; a < std::min(3.0, full_throttle_mps2(p, m)); a += 0.25) {
      const Pedals pedals = pedals_for(p, m, a, false);
      EXPECT_EQ(pedals.brake_kpa, 0.0);
      EXPECT_NEAR(plant_mps2(plant, m, pedals.throttle_fraction), a, bound_mps2)
          << speed_mps << " m/s in " << gear;
    }
    EXPECT_NEAR(coasting_mps2(p, m), plant_mps2(plant, m, 0.0), 0.1) << speed_mps;
  }
}

TEST(Drivetrain, OnePedalAtATimeAndNoneInTheDeadZone) {
  const DrivetrainParams p = av21();
  const Motion m{.speed_mps = 40.0, .gear = 3};
  const double coasting = coasting_mps2(p, m);
  double last = 1.0;
  for (double a = 3.0; a > -8.0; a -= 0.05) {
    const Pedals pedals = pedals_for(p, m, a, false);
    EXPECT_TRUE(pedals.throttle_fraction == 0.0 || pedals.brake_kpa == 0.0);
    const double signed_kpa = pedals.throttle_fraction - pedals.brake_kpa;
    EXPECT_LE(signed_kpa, last);
    last = signed_kpa;
    if (a < coasting && a > coasting - p.dead_zone_mps2) {
      EXPECT_EQ(signed_kpa, 0.0) << a;
    }
  }
  const double inside = coasting - 0.5 * p.dead_zone_mps2;
  EXPECT_NEAR(pedals_for(p, m, inside, true).brake_kpa, 0.5 * p.dead_zone_mps2 * 350.0, 1e-9);
  EXPECT_NEAR(pedals_for(p, m, coasting - 3.0, false).brake_kpa, 3.0 * 350.0, 1e-9);
}

TEST(Drivetrain, AClimbCostsItsShareOfGravity) {
  const DrivetrainParams p = av21();
  const Motion level{.speed_mps = 40.0, .gear = 3};
  Motion up = level;
  up.climb_rad = 0.03;
  EXPECT_NEAR(resistance_mps2(p, up) - resistance_mps2(p, level), kGravity_mps2 * std::sin(0.03),
              1e-12);
  EXPECT_GT(pedals_for(p, up, 0.0, false).throttle_fraction,
            pedals_for(p, level, 0.0, false).throttle_fraction);
}

TEST(Drivetrain, NeutralHasNeitherDriveNorEngineDrag) {
  const DrivetrainParams p = av21();
  const Motion neutral{.speed_mps = 40.0, .gear = 0};
  EXPECT_EQ(pedals_for(p, neutral, 2.0, false).throttle_fraction, 0.0);
  EXPECT_EQ(coasting_mps2(p, neutral), -resistance_mps2(p, neutral));
}

TEST(Drivetrain, WithoutAnEngineInTheFileThePowerCounts) {
  DrivetrainParams p = av21();
  p.car.engine = {};
  const Motion m{.speed_mps = 64.0, .gear = 5};  // 320 W/kg: 5 m/s2
  EXPECT_NEAR(pedals_for(p, m, 2.5 - resistance_mps2(p, m), false).throttle_fraction, 0.5, 1e-9);
  EXPECT_NEAR(full_throttle_mps2(p, m), 5.0 - resistance_mps2(p, m), 1e-9);
}

}  // namespace
}  // namespace pitwall::control
