// SPDX-License-Identifier: Apache-2.0
// What becomes of the samples of inertial units and wheels, and what stands in for them.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "tests/vehicle/autonomy/localization/drive.hpp"

namespace pitwall::localization {
namespace {

using testing::banked_turn;
using testing::Course;
using testing::Rig;
using world::Monitor;

std::unique_ptr<Rig> running(const Course& course) {
  auto rig = std::make_unique<Rig>();
  rig->course = course;
  rig->run(6.0);
  return rig;
}

Gate verdict(const Rig& rig, Source source, std::size_t unit) {
  return rig.state.streams[static_cast<std::size_t>(source)][unit].verdict;
}

TEST(Motion, TheSecondImuStandsBy) {
  const auto rig = running(Course{});
  EXPECT_GT(rig->count(Source::kImu, 1, Gate::kStandby), 300u);
  EXPECT_EQ(rig->count(Source::kImu, 0, Gate::kStandby), 0u);
}

// F24: the unit in use gets a bias; within 200 ms the other one is used and the car stays where it
// is.
TEST(Motion, AnImuThatStepsIsBlamedAndTheOtherTakesOver) {
  for (const double step : {0.06, -0.2}) {
    auto rig = running(banked_turn());
    rig->sensors.gyro_bias_rad_per_s[0] += step;
    rig->run(0.2);
    EXPECT_TRUE(rig->out.seen.has(Monitor::kUnitAgreement)) << step;
    EXPECT_EQ(verdict(*rig, Source::kImu, 0), Gate::kDisagrees) << step;
    EXPECT_EQ(verdict(*rig, Source::kImu, 1), Gate::kAccepted) << step;
    for (int i = 0; i < 500; ++i) {
      rig->tick();
      ASSERT_LT(rig->position_error_m(), 0.15) << step << " " << i;
    }
    EXPECT_NEAR(rig->out.ego.yaw_rate_rad_per_s, rig->truth().yaw_rate_rad_per_s, 0.012);
    rig->sensors.gyro_bias_rad_per_s[0] -= step;
    rig->run(2.0);
    EXPECT_EQ(verdict(*rig, Source::kImu, 0), Gate::kAccepted) << "after a while";
  }
}

TEST(Motion, AStandbyImuThatStepsIsSeenAndHarmsNothing) {
  auto rig = running(banked_turn());
  rig->sensors.gyro_bias_rad_per_s[1] += 0.1;
  rig->run(0.3);
  EXPECT_TRUE(rig->out.seen.has(Monitor::kUnitAgreement));
  EXPECT_EQ(verdict(*rig, Source::kImu, 1), Gate::kDisagrees);
  EXPECT_EQ(verdict(*rig, Source::kImu, 0), Gate::kAccepted);
}

TEST(Motion, LosingAllImusIsNotGood) {
  auto rig = running(Course{});
  rig->sensors.imu_silent = {true, true};
  rig->run(1.0);
  EXPECT_EQ(rig->out.ego.validity, world::Validity::kDeadReckoning);
  EXPECT_TRUE(rig->out.seen.has(Monitor::kStreamAge));
}

// The steering angle that holds the turn in steady state, worked out on its own.
TEST(Motion, WithoutAnyImuTheCarTurnsAsItsSteeringSays) {
  auto rig = running(banked_turn());
  const world::EgoState truth = rig->truth();
  const double angle_rad =
      rig->params.bicycle.wheelbase_m * truth.yaw_rate_rad_per_s / truth.vx_mps +
      rig->params.bicycle.understeer_rad_per_mps2 * truth.ay_mps2;
  rig->sensors.imu_silent = {true, true};
  for (int i = 0; i < 100; ++i) {
    rig->signals.steering_motor_rad = {.value = angle_rad * rig->params.steering_ratio,
                                       .at = rig->now() + milliseconds(10),
                                       .received = true};
    rig->tick();
    ASSERT_NEAR(rig->out.ego.yaw_rate_rad_per_s, truth.yaw_rate_rad_per_s, 0.02) << i;
    ASSERT_LT(rig->position_error_m(), 0.2) << i;
  }
}

// F25, for every wheel and every way it may fail: it does not enter, it is seen, and the speed
// stays right even with no receiver to correct it.
TEST(Motion, NoSingleWheelEntersThatLies) {
  for (std::size_t wheel = 0; wheel < world::kCorners; ++wheel) {
    for (const double factor : {0.0, 1.5, kUnset}) {
      auto rig = running(banked_turn());
      rig->sensors.wheel_factor[wheel] = factor;
      rig->run(0.02);
      EXPECT_TRUE(rig->out.seen.has(Monitor::kWheelAgreement)) << wheel << " " << factor;
      rig->sensors.no_fix = true;
      rig->run(1.0);
      EXPECT_NEAR(rig->out.ego.vx_mps, rig->truth().vx_mps, 0.3) << wheel << " " << factor;
      EXPECT_EQ(rig->state.wheels.verdict, Gate::kAccepted);
    }
  }
}

TEST(Motion, ExcludedWheelsAreNotUsed) {
  auto rig = running(banked_turn());
  rig->use.excluded = 1U << static_cast<unsigned>(world::Excludable::kWheels);
  rig->sensors.wheel_factor.fill(0.1);
  rig->run(2.0);
  EXPECT_EQ(rig->state.wheels.verdict, Gate::kExcluded);
  EXPECT_FALSE(rig->out.seen.has(Monitor::kWheelAgreement));
  EXPECT_LT(rig->position_error_m(), 0.06);
}

}  // namespace
}  // namespace pitwall::localization
