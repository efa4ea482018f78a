// SPDX-License-Identifier: Apache-2.0
#include "vehicle/parameters/stop_section.hpp"

#include <gtest/gtest.h>

#include "tests/vehicle/parameters/mutation.hpp"

namespace pitwall::parameters {
namespace {

using testing::av21;
using testing::refusal;
using testing::with;

TEST(StopSection, TyresOfTheFileReachPlanningAndTheStopOfLastResort) {
  const auto car = read_car(av21(), "car.yaml");
  ASSERT_TRUE(car) << to_string(car.error());
  const pipeline::CarParams& p = car->params;
  EXPECT_EQ(p.supervisor.safe_stop.tyres.share, p.planning.line.friction.tyres.share);
}

TEST(StopSection, PlanningAndTheStopReckonWithTheSameFriction) {
  const std::string other = with(av21(), "friction: 1.0 ", "friction: 0.9 ");
  const auto car = read_car(other, "car.yaml");
  ASSERT_TRUE(car) << to_string(car.error());
  EXPECT_EQ(car->params.supervisor.safe_stop.friction, 0.9);
  EXPECT_EQ(car->params.planning.stop_friction, 0.9);
}

TEST(StopSection, ATableThatFallsAndALawThatIsNoneAreRefusedByName) {
  const std::string falls = refusal(with(av21(), "share: [0.60, 0.74", "share: [0.80, 0.74"));
  EXPECT_NE(falls.find("share"), std::string::npos) << falls;
  const std::string speed = refusal(with(av21(), "speed_law: limited", "speed_law: fast"));
  EXPECT_NE(speed.find("limited"), std::string::npos) << speed;
}

TEST(StopSection, TheDefaultFileLimitsTheSpeedAndTheBaselineIsAskedForByName) {
  const auto car = read_car(av21(), "car.yaml");
  ASSERT_TRUE(car) << to_string(car.error());
  EXPECT_EQ(car->params.planning.speed_law, planning::SpeedLaw::kLimited);
  const auto paper = read_car(with(av21(), "speed_law: limited", "speed_law: paper"), "car.yaml");
  ASSERT_TRUE(paper) << to_string(paper.error());
  EXPECT_EQ(paper->params.planning.speed_law, planning::SpeedLaw::kPaper);
}

}  // namespace
}  // namespace pitwall::parameters
