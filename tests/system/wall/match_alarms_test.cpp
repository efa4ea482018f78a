// What the pit wall hears of a match: nothing of one that goes well, and of each incident of the
// paper's season the alarm that says what to do.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "hil/bench/loading.hpp"
#include "protocol/vocabulary/units.hpp"
#include "tests/system/wall/wall_watch.hpp"

namespace pitwall {
namespace {

std::set<std::string> alarms_in(const std::string& match, const state::Expectations& expected) {
  const std::string root = PITWALL_SOURCE_DIR;
  const auto loaded = bench::load(root + "/hil/scenarios/matches/" + match + ".yaml", root);
  if (!loaded) return ADD_FAILURE() << to_string(loaded.error()), std::set<std::string>{};
  WallWatch wall;
  wall.evaluator.expect(expected);
  bench::LockstepOptions options;
  wall.listen(options);
  const auto run = bench::run_lockstep(*loaded, options);
  EXPECT_TRUE(run && run->passed());
  return wall.alarms();
}

TEST(MatchAlarms, NoneOfAMatchInWhichBothPassTwice) {
  EXPECT_EQ(alarms_in("competition", {}), std::set<std::string>{});
}

TEST(MatchAlarms, AnotherRoundSpeedThanWasAnnounced) {
  const auto alarms = alarms_in("match_wrong_speed", {.round_speed_mps = from_mph(100)});
  EXPECT_TRUE(alarms.contains("round_speed_conflict"));
}

TEST(MatchAlarms, AnotherWhoIsLoggedInForOurCorrections) {
  EXPECT_TRUE(alarms_in("match_rtk_login", {}).contains("correction_conflict"));
}

}  // namespace
}  // namespace pitwall
