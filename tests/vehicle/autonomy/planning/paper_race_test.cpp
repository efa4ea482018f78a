// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/planning/paper_race.hpp"

#include <gtest/gtest.h>

#include "tests/vehicle/autonomy/planning/race_rig.hpp"

namespace pitwall::planning {
namespace {

using enum PassPhase;

// One tick from any state, with the rival at this gap.
PassState decide(double gap_m, bool may_pass, std::size_t line = 0, bool known = true) {
  PassState state;
  state.line = line;
  Rival rival;
  if (known) rival = {.known = true, .gap_m = gap_m, .speed_mps = 40.0};
  return advance_paper(testing::pass_params(), state,
                       {.rival = rival, .base_mps = 40.0, .most_mps = 60.0, .may_pass = may_pass},
                       2, Instant{});
}

TEST(PaperRace, EachPrimitiveHasItsCase) {
  EXPECT_EQ(decide(-25.0, false).phase, kTrail);
  EXPECT_EQ(decide(-25.0, true).phase, kPass);
  EXPECT_EQ(decide(-25.0, true).line, 1u);
  EXPECT_EQ(decide(5.0, true).phase, kFree) << "the leader maintains";
  EXPECT_FALSE(std::isfinite(decide(5.0, false, 1).pass_mps)) << "without the right too";
  EXPECT_EQ(decide(5.0, true, 1).pass_mps, 60.0) << "the merge goes on";
  EXPECT_FALSE(std::isfinite(decide(34.0, true, 1).pass_mps));
  EXPECT_EQ(decide(5.0, true, 1).line, 1u) << "not before the gap of the rule";
  EXPECT_EQ(decide(34.0, true, 1).line, 0u);
  EXPECT_EQ(decide(0.0, true, 0, false).phase, kFree);
}

// Its fault: who leads is decided anew at every tick.
TEST(PaperRace, AMetreOfNoiseChangesItsSpeed) {
  const auto speed = [](double gap_m) { return decide(gap_m, true, 1).pass_mps; };
  EXPECT_EQ(speed(-0.1), 48.0);
  EXPECT_EQ(speed(0.1), 60.0);
}

}  // namespace
}  // namespace pitwall::planning
