// SPDX-License-Identifier: Apache-2.0
#include "vehicle/envelope/throttle.hpp"

#include <gtest/gtest.h>

#include "hil/plant/engine.hpp"
#include "hil/plant/params.hpp"
#include "tests/vehicle/envelope/car.hpp"

namespace pitwall::envelope {
namespace {

const Engine kAv21 = testing::av21_engine();

// Against the engine of the modelled car, which has the rows of its own dyno sheet: half of the
// largest change of a share between two rows is 0.06 of 480 Nm.
TEST(Throttle, TorqueIsThatOfThePlant) {
  const plant::Params plant;
  for (double rpm = 2800.0; rpm <= 7200.0; rpm += 50.0) {
    EXPECT_NEAR(drag_torque_nm(kAv21, rpm), plant::friction_nm(plant.engine, rpm), 1e-9);
    for (double throttle = 0.0; throttle <= 1.0; throttle += 0.05)
      EXPECT_NEAR(torque_nm(kAv21, rpm, throttle),
                  plant::engine_torque_nm(plant.engine, rpm, throttle), 0.06 * 480.0)
          << rpm << ' ' << throttle;
  }
}

TEST(Throttle, IsTheInverseOfTheTorque) {
  for (double rpm = 1000.0; rpm <= 7190.0; rpm += 90.0)
    for (double throttle = 0.0; throttle <= 1.0; throttle += 0.04)
      EXPECT_NEAR(throttle_for(kAv21, rpm, torque_nm(kAv21, rpm, throttle)), throttle, 1e-12)
          << rpm;
}

TEST(Throttle, IsClosedBelowTheDragAndFullBeyondTheTorque) {
  EXPECT_EQ(throttle_for(kAv21, 4000.0, -200.0), 0.0);
  EXPECT_EQ(throttle_for(kAv21, 4000.0, -drag_torque_nm(kAv21, 4000.0)), 0.0);
  EXPECT_EQ(throttle_for(kAv21, 4000.0, 900.0), 1.0);
  EXPECT_EQ(throttle_for(kAv21, 9000.0, 900.0), 1.0);
}

}  // namespace
}  // namespace pitwall::envelope
