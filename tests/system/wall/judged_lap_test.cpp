// SPDX-License-Identifier: Apache-2.0
// The base's alarms in front of the real car: silent while it is healthy, and heard when it is not.
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "hil/bench/loading.hpp"
#include "tests/system/wall/wall_watch.hpp"

namespace pitwall {
namespace {

// What the car says, judged as it is said; the way to the base is a perfect one.
struct JudgedLap {
  WallWatch wall;
  std::set<std::string> alarms;  // that ever came

  void run(const std::vector<scenario::Fault>& faults, Duration length, double tyres_c = 85.0) {
    const std::string root = PITWALL_SOURCE_DIR;
    auto loaded = bench::load(root + "/hil/scenarios/lvms_flying_lap.yaml", root);
    ASSERT_TRUE(loaded) << to_string(loaded.error());
    loaded->scenario.expect.clear();
    loaded->scenario.faults = faults;
    loaded->scenario.duration = length;
    loaded->scenario.tyres.temperature_c = tyres_c;
    bench::LockstepOptions options;
    wall.listen(options);
    (void)bench::run_lockstep(loaded->scenario, loaded->setup, options);
    alarms = wall.alarms();
  }
};

double coldest(const JudgedLap& lap) {
  constexpr state::FieldId kTyreMin = state::id_of(state::BaseField::kTyreMin);
  return lap.wall.evaluator.view(lap.wall.picture, kTyreMin, Instant{}).value;
}

// All that the demonstration drives: engine start, out lap, flying laps and the stop at their end.
TEST(JudgedLap, AHealthyRunHasNoAlarm) {
  JudgedLap lap;
  lap.run({}, seconds(180));
  EXPECT_GT(coldest(lap), 60.0);
  EXPECT_EQ(lap.alarms, std::set<std::string>{});
}

TEST(JudgedLap, TyresThatAreColdForTheSpeedAreSeenAndNothingElse) {
  JudgedLap lap;
  lap.run({}, seconds(60), 30.0);
  EXPECT_LT(coldest(lap), lap.wall.evaluator.tyre_gate().temperature_c.back());
  EXPECT_EQ(lap.alarms, std::set<std::string>{"tyres_cold"});
}

TEST(JudgedLap, AReceiverWithoutASolutionIsSeen) {
  JudgedLap lap;
  lap.run({scenario::Fault{.kind = "gnss_no_solution",
                           .at = seconds(30),
                           .lasts = seconds(5),
                           .unit = 1,
                           .place = {}}},
          seconds(40));
  EXPECT_TRUE(lap.alarms.contains("gnss_one_bad"));
  EXPECT_FALSE(lap.alarms.contains("gnss_both_bad"));
  EXPECT_FALSE(lap.alarms.contains("position_lost"));
}

}  // namespace
}  // namespace pitwall
