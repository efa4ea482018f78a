// SPDX-License-Identifier: Apache-2.0
#include "vehicle/safety/command_choice.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/vehicle/safety/drive.hpp"
#include "vehicle/safety/frame_gate.hpp"

namespace pitwall::safety {
namespace {

using testing::Drive;
using world::Mode;

TEST(CommandChoice, ACommandWithANumberMissingOrOutOfRangeIsNotUsable) {
  const world::ActuatorCommand good{
      .at = {}, .road_wheel_rad = 0.0, .throttle_fraction = 0.5, .brake_kpa = 0.0, .gear = 1};
  EXPECT_TRUE(is_usable(good));
  for (const double bad : {kUnset, HUGE_VAL, -1.0}) {
    world::ActuatorCommand c = good;
    c.throttle_fraction = bad;
    EXPECT_FALSE(is_usable(c));
    c = good;
    c.brake_kpa = bad;
    EXPECT_FALSE(is_usable(c));
  }
}

// However hard control brakes, a controlled stop stays within what the gate lets pass.
TEST(CommandChoice, AControlledStopBrakesWithinTheGripAtEverySpeed) {
  for (const double v : {5.0, 20.0, 40.0, 60.0, 75.0}) {
    for (const double before_kpa : {0.0, 5000.0}) {
      Drive d;
      d.race();
      d.car.control.throttle_fraction = 0.0;
      d.car.control.brake_kpa = before_kpa;
      d.run(milliseconds(500));
      d.car.requests.stop = true;
      d.car.control.brake_kpa = 5500.0;
      const GateParams gate;
      for (int tick = 0; tick < 60; ++tick) {
        d.speed_mps = v;
        d.car.ego.vx_mps = v;
        const double last_kpa = d.out.command.brake_kpa;
        d.tick();
        ASSERT_EQ(d.out.mode, Mode::kControlledStop);
        const double kpa = d.out.command.brake_kpa;
        ASSERT_TRUE(kpa <= stop_brake_limit_kpa(gate, v) || kpa < last_kpa) << v << ' ' << kpa;
      }
    }
  }
}

}  // namespace
}  // namespace pitwall::safety
