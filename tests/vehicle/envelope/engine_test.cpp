// SPDX-License-Identifier: Apache-2.0
#include "vehicle/envelope/engine.hpp"

#include <gtest/gtest.h>

#include "hil/plant/engine.hpp"
#include "hil/plant/params.hpp"
#include "tests/vehicle/envelope/car.hpp"

namespace pitwall::envelope {
namespace {

const Engine kEngine = testing::av21_engine();

TEST(Engine, TheGearIsThatOfACarWhichSpeedsUp) {
  EXPECT_EQ(gear_at(kEngine, 0.0), 1U);
  EXPECT_EQ(gear_at(kEngine, 21.5), 1U);
  EXPECT_EQ(gear_at(kEngine, 21.6), 2U);
  EXPECT_EQ(gear_at(kEngine, 56.0), 4U);
  EXPECT_EQ(gear_at(kEngine, 90.0), 6U);
}

// Against the powertrain of the modelled car: torque of its dyno sheet through its gears. The table
// has 11 rows of 16, which leaves 8 Nm of 426 between them.
TEST(Engine, ForceIsThatOfThePlant) {
  const plant::Params plant;
  for (double v = 12.0; v < 88.0; v += 0.5) {
    const std::size_t gear = gear_at(kEngine, v);
    const double ratio = plant.drivetrain.final_drive * plant.drivetrain.gear[gear - 1];
    const double rpm = to_rpm(v / plant.rear.radius_m * ratio);
    EXPECT_NEAR(rpm, engine_rpm(kEngine, gear, v), 1e-6);
    const double held_rpm = std::max(rpm, plant.engine.launch_rpm);  // the clutch slips below
    const double force_n = plant::engine_torque_nm(plant.engine, held_rpm, 1.0) * ratio *
                           plant.drivetrain.efficiency / plant.rear.radius_m;
    EXPECT_NEAR(drive_mps2(kEngine, v), force_n / plant.chassis.mass_kg,
                0.02 * force_n / plant.chassis.mass_kg)
        << v;
  }
}

TEST(Engine, BeyondTheLastSpeedIsNoForce) {
  EXPECT_GT(drive_mps2(kEngine, 87.0), 3.0);
  EXPECT_EQ(drive_mps2(kEngine, 90.0), 0.0);
}

TEST(Engine, TablesRiseAndFall) {
  EXPECT_TRUE(is_legal(kEngine));
  Engine wrong = kEngine;
  wrong.rpm[4] = wrong.rpm[3];
  EXPECT_FALSE(is_legal(wrong));
  wrong = kEngine;
  wrong.ratio[2] = wrong.ratio[1];
  EXPECT_FALSE(is_legal(wrong));
  wrong = kEngine;
  wrong.part_throttle[3].throttle = wrong.part_throttle[2].throttle;
  EXPECT_FALSE(is_legal(wrong));
  wrong = kEngine;
  wrong.part_throttle[3].share[7] = wrong.part_throttle[2].share[7];
  EXPECT_FALSE(is_legal(wrong));
}

}  // namespace
}  // namespace pitwall::envelope
