// What can be told of the live bench without a CAN interface: what is refused, and that then
// nothing has been started. The rest runs where CAN is (tests/system/live).
// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/live/live.hpp"

#include <gtest/gtest.h>

#include <array>

#include "tests/hil/bench/live/trap.hpp"

namespace pitwall::bench {
namespace {

TEST(Live, AnInterfaceThatDoesNotExistIsAProblemThatNamesIt) {
  Trap trap;
  const auto run = run_live(lap(), std::array{trap.plan()});
  ASSERT_FALSE(run);
  EXPECT_NE(to_string(run.error()).find("no_such_can"), std::string::npos)
      << to_string(run.error());
  EXPECT_TRUE(trap.untouched());
}

TEST(Live, CarsThatCannotShareARunAreRefusedBeforeAnythingStarts) {
  Trap trap;
  scenario::Scenario longer = lap().scenario;
  longer.name = "longer";
  longer.duration = longer.duration + seconds(1);
  const LivePlan plan = trap.plan();
  const auto run = run_live(std::array{LiveStack{lap().scenario, lap().setup, plan},
                                       LiveStack{longer, lap().setup, plan}});
  ASSERT_FALSE(run);
  EXPECT_EQ(run.error().place, "longer");
  EXPECT_TRUE(trap.untouched());
}

}  // namespace
}  // namespace pitwall::bench
