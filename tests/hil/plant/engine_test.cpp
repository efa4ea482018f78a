// SPDX-License-Identifier: Apache-2.0
#include "hil/plant/engine.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "protocol/vocabulary/units.hpp"

namespace pitwall::plant {
namespace {

// Figures of the dyno sheet, an independent copy to compare with: rpm, throttle, Nm.
struct Measured {
  double rpm, throttle, torque_nm;
};

TEST(Engine, FollowsTheDynoWithinTwoPercent) {
  for (const Measured& m :
       {Measured{4930, 1.0, 479.7}, Measured{3117, 0.3, 103.1}, Measured{3500, 1.0, 400},
        Measured{4000, 1.0, 462}, Measured{4500, 1.0, 478}, Measured{5000, 1.0, 477},
        Measured{5500, 1.0, 467}, Measured{6000, 1.0, 456}, Measured{6500, 1.0, 422},
        Measured{3650, 0.5, 216.1}})
    EXPECT_NEAR(engine_torque_nm(Engine{}, m.rpm, m.throttle), m.torque_nm, 0.02 * m.torque_nm)
        << m.rpm << " " << m.throttle;
}

// None of these is a point of the table: speeds between its rows and throttles between its columns.
TEST(Engine, FollowsTheDynoWithinFourPercentBetweenItsPoints) {
  for (const Measured& m :
       {Measured{2700, 0.3, 110.35}, Measured{2900, 0.3, 107.5}, Measured{3650, 0.3, 85.63},
        Measured{4360, 0.3, 63.86}, Measured{3650, 0.65, 365.2}, Measured{4400, 0.5, 314.7},
        Measured{4400, 0.65, 372.9}, Measured{4400, 0.8, 472.4}, Measured{5000, 0.3, 47.47},
        Measured{5000, 0.5, 265.4}, Measured{5000, 0.65, 386.5}, Measured{5900, 0.5, 230.7},
        Measured{5900, 0.65, 387.8}, Measured{5950, 0.7, 423.4}, Measured{6060, 0.5, 217.3},
        Measured{6060, 0.8, 445.7}, Measured{4950, 0.75, 437.4}, Measured{6775, 0.75, 372.0}})
    EXPECT_NEAR(engine_torque_nm(Engine{}, m.rpm, m.throttle), m.torque_nm, 0.04 * m.torque_nm)
        << m.rpm << " " << m.throttle;
}

TEST(Engine, FallsToFrictionPastTheLimiter) {
  const Engine e;
  EXPECT_GT(engine_torque_nm(e, e.limiter_rpm - 1.0, 1.0), 300.0);
  for (const double rpm : {e.limiter_rpm + e.limiter_width_rpm, 9000.0, 20000.0})
    EXPECT_EQ(engine_torque_nm(e, rpm, 1.0), -friction_nm(e, rpm));
}

TEST(Engine, TorqueGrowsWithThrottleAndBrakesWithoutIt) {
  for (const double rpm : {2800.0, 3000.0, 3650.0, 4500.0, 5600.0, 6800.0}) {
    EXPECT_EQ(engine_torque_nm(Engine{}, rpm, 0.0), -friction_nm(Engine{}, rpm));
    for (int i = 0; i < 100; ++i)
      EXPECT_LT(engine_torque_nm(Engine{}, rpm, 0.01 * i),
                engine_torque_nm(Engine{}, rpm, 0.01 * (i + 1)))
          << rpm << " " << i;
  }
}

TEST(Engine, HasNoStepsInSpeedOrThrottle) {
  const Engine e;
  for (double rpm = 1000.0; rpm < 7400.0; rpm += 1.0)
    for (const double u : {0.1, 0.3, 0.42, 0.66, 1.0})
      ASSERT_NEAR(engine_torque_nm(e, rpm, u), engine_torque_nm(e, rpm + 1.0, u), 5.0) << rpm;
  for (const double rpm : {2000.0, 3600.0, 6000.0})
    for (double u = 0.0; u < 1.0; u += 0.001)
      ASSERT_NEAR(engine_torque_nm(e, rpm, u), engine_torque_nm(e, rpm, u + 0.001), 2.0) << u;
}

TEST(Engine, AFaultTakesItsShareOfWhatBurns) {
  Engine half;
  half.power = 0.5;
  for (const double u : {0.4, 1.0}) {
    const double whole_nm = engine_torque_nm(Engine{}, 5000.0, u) + friction_nm(half, 5000.0);
    EXPECT_NEAR(engine_torque_nm(half, 5000.0, u) + friction_nm(half, 5000.0), 0.5 * whole_nm,
                1e-9);
  }
  half.power = 0.0;
  EXPECT_NEAR(engine_torque_nm(half, 5000.0, 1.0), -friction_nm(half, 5000.0), 1e-9);
}

// Kilograms per kWh at the crankshaft.
double consumption(double rpm, double throttle) {
  const Engine e;
  const double torque_nm = engine_torque_nm(e, rpm, throttle);
  return fuel_flow_kgps(e, Fuel{}, rpm, torque_nm) / (torque_nm * from_rpm(rpm)) * 3.6e6;
}

TEST(Fuel, ConsumptionIsThatOfATurboPetrolEngine) {
  for (const double rpm : {4000.0, 5000.0, 6500.0}) {
    EXPECT_GT(consumption(rpm, 1.0), 0.26);
    EXPECT_LT(consumption(rpm, 1.0), 0.36);
    EXPECT_GT(consumption(rpm, 0.4), consumption(rpm, 1.0));  // friction weighs more
  }
}

TEST(Fuel, IsNotBurntInOverrunAndIdlesOnFriction) {
  const Engine e;
  EXPECT_EQ(fuel_flow_kgps(e, Fuel{}, 5000.0, engine_torque_nm(e, 5000.0, 0.0)), 0.0);
  const double idle_kgps = fuel_flow_kgps(e, Fuel{}, e.idle_rpm, 0.0);
  EXPECT_NEAR(idle_kgps * 0.30 * 42.7e6, friction_nm(e, e.idle_rpm) * from_rpm(e.idle_rpm), 1e-6);
}

}  // namespace
}  // namespace pitwall::plant
