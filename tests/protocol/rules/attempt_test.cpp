// SPDX-License-Identifier: Apache-2.0
#include "protocol/rules/attempt.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <type_traits>

namespace pitwall::rules {
namespace {

static_assert(std::is_trivially_copyable_v<AttemptState>);

constexpr double kTrack_m = 2400.0, kLength_m = 4.9, kRound_mps = 50.0, kTick_s = 0.01;

// The attacker trails 20 m behind for 10 s, then gains 3 m/s on the outside lane.
struct Drive {
  double waving_s = 10.0, launch_s = 12.0, gain_mps = 3.0, most_lead_m = 200.0;
  double inside_lead_m = 40.0;  // where the attacker takes the inside lane
  std::function<void(double t_s, AttemptView& now)> change = [](double, AttemptView&) {};

  AttemptView at(double t_s) const {
    const double lead_m =
        std::min(-20.0 - kLength_m + gain_mps * std::max(0.0, t_s - launch_s), most_lead_m);
    AttemptView now{.pass_allowed = t_s >= waving_s,
                    .lead_m = lead_m,
                    .length_m = kLength_m,
                    .attacker_travelled_m = kRound_mps * t_s + lead_m,
                    .defender_mps = kRound_mps,
                    .attacker_inside = lead_m <= -kLength_m - 10.0 || lead_m >= inside_lead_m,
                    .defender_inside = true};
    change(t_s, now);
    return now;
  }
};

struct Judged {
  AttemptState state;
  double end_s = kUnset;
  AttemptView last;
};

Judged judged(const Drive& drive, double time_s = 400.0) {
  Judged run;
  Phase phase = Phase::kClosingUp;
  for (int tick = 0; tick * kTick_s < time_s; ++tick) {
    run.end_s = tick * kTick_s;
    run.last = drive.at(run.end_s);
    run.state = step({}, kRound_mps, kTrack_m, run.state, run.last);
    EXPECT_GE(run.state.phase, phase) << "phases only follow";
    phase = run.state.phase;
    if (run.state.ending) break;
  }
  return run;
}

TEST(Attempt, PassesWithThirtyMetresOfRoadAndAClosedDoor) {
  const Judged run = judged({});
  ASSERT_EQ(run.state.ending, Ending::kPassed);
  EXPECT_NEAR(run.last.lead_m, 40.0, 0.05);
  // 30 m of road are 34.9 m between the centres: 59.8 m gained at 3 m/s after 12 s.
  const double clear_s = 12.0 + 59.8 / 3.0;
  EXPECT_NEAR(run.state.clear_at_m, 34.9 + kRound_mps * clear_s, 1.0);
  EXPECT_NEAR(run.state.waving_at_m, kRound_mps * 10.0 - 24.9, 1.0);
}

TEST(Attempt, ThirtyMetresAreCountedBetweenTheCars) {
  EXPECT_EQ(judged({.inside_lead_m = kLength_m + 29.9}).state.ending, Ending::kCutIn);
  EXPECT_EQ(judged({.inside_lead_m = kLength_m + 30.0}).state.ending, Ending::kPassed);
}

TEST(Attempt, FailsWhenTwoLapsOfTheAttackerAreUsed) {
  const Judged run = judged({.most_lead_m = kLength_m + 29.0});
  ASSERT_EQ(run.state.ending, Ending::kOutOfLaps);
  const double used = laps_used(run.state, kTrack_m, run.last.attacker_travelled_m);
  EXPECT_NEAR(used, 2.0, 1e-3);
  EXPECT_NEAR(run.state.most_lead_m, kLength_m + 29.0, 1e-9);
}

TEST(Attempt, APassInTheLastMetreOfTwoLapsCounts) {
  // Clear at 4799 m and 4801 m after waving green: the launch sets it.
  for (const auto& [metres, ending] :
       {std::pair{4799.0, Ending::kPassed}, std::pair{4801.0, Ending::kOutOfLaps}}) {
    const double gained_m = 2.0 * kLength_m + 50.0;
    const double clear_s = 10.0 + (metres - gained_m) / kRound_mps;
    EXPECT_EQ(judged({.launch_s = clear_s - gained_m / 3.0}).state.ending, ending) << metres;
  }
}

TEST(Attempt, FailsWhereTheAttackerNeverTrails) {
  EXPECT_EQ(judged({.waving_s = 1e9, .launch_s = 1e9}).state.ending, Ending::kNotClosedUp);
}

TEST(Attempt, ADefenderThatNeverKeepsToItsRuleIsNotTheAttackersFailure) {
  const auto never = [](std::function<void(AttemptView&)> change) {
    return judged({.waving_s = 1e9,
                   .launch_s = 1e9,
                   .change = [change](double, AttemptView& now) { change(now); }})
        .state.ending;
  };
  EXPECT_EQ(never([](AttemptView& v) { v.defender_mps = 30.0; }), Ending::kDefenderSpeed);
  EXPECT_EQ(never([](AttemptView& v) { v.defender_inside = false; }), Ending::kDefenderLeftLane);
}

TEST(Attempt, DrawingLevelBeforeWavingGreenIsEarly) {
  const Judged run = judged({.waving_s = 100.0});
  EXPECT_EQ(run.state.ending, Ending::kEarly);
  EXPECT_NEAR(run.last.lead_m, -kLength_m, 0.05);
}

TEST(Attempt, WavingGreenThatIsTakenBackGivesNoLapsBack) {
  const Drive twice{.most_lead_m = 0.0, .change = [](double t_s, AttemptView& now) {
                      if (t_s > 60.0 && t_s < 70.0) now.pass_allowed = false;
                    }};
  const Judged run = judged(twice);
  EXPECT_EQ(run.state.ending, Ending::kOutOfLaps);
  EXPECT_NEAR(run.state.waving_at_m, kRound_mps * 10.0 - 24.9, 1.0);
}

TEST(Attempt, TheDoorHasToBeClosedWithinALapOfTheAttacker) {
  const Judged run = judged({.inside_lead_m = 1e9});
  EXPECT_EQ(run.state.ending, Ending::kDoorOpen);
  EXPECT_NEAR(run.last.attacker_travelled_m - run.state.clear_at_m, kTrack_m, 1.0);
}

TEST(Attempt, FallingBackAfterThePassAndCuttingInIsNoPass) {
  const Drive fades{.inside_lead_m = 1e9, .change = [](double t_s, AttemptView& now) {
                      if (t_s < 40.0) return;
                      now.lead_m = 20.0;
                      now.attacker_inside = true;
                    }};
  EXPECT_EQ(judged(fades).state.ending, Ending::kCutIn);
}

TEST(Attempt, FallingBehindAgainIsNoClosedDoor) {
  const Drive fades{.inside_lead_m = 1e9, .change = [](double t_s, AttemptView& now) {
                      if (t_s < 40.0) return;
                      now.lead_m = -20.0;
                      now.attacker_inside = true;
                    }};
  EXPECT_EQ(judged(fades).state.ending, Ending::kDoorOpen);
}

struct Breach {
  const char* name;
  std::function<void(AttemptView&)> change;
  Ending ending;
};

class BreachOf : public testing::TestWithParam<Breach> {};

// Each from 15 s on, within the pass.
TEST_P(BreachOf, EndsTheAttemptAtOnce) {
  const Drive drive{.change = [](double t_s, AttemptView& now) {
    if (t_s >= 15.0) GetParam().change(now);
  }};
  const Judged run = judged(drive);
  EXPECT_EQ(run.state.ending, GetParam().ending);
  EXPECT_NEAR(run.end_s, 15.0, 0.02);
}

INSTANTIATE_TEST_SUITE_P(
    Each, BreachOf,
    testing::Values(
        Breach{"lane", [](AttemptView& v) { v.defender_inside = false; },
               Ending::kDefenderLeftLane},
        Breach{"fast", [](AttemptView& v) { v.defender_mps = kRound_mps + 2.1; },
               Ending::kDefenderSpeed},
        Breach{"slow", [](AttemptView& v) { v.defender_mps = kRound_mps - 4.1; },
               Ending::kDefenderSpeed},
        Breach{"unknown_speed", [](AttemptView& v) { v.defender_mps = kUnset; },
               Ending::kDefenderSpeed},
        Breach{"declined", [](AttemptView& v) { v.declined = true; }, Ending::kDeclined},
        Breach{"stopped", [](AttemptView& v) { v.stopped = true; }, Ending::kStopped},
        Breach{"unknown_lead", [](AttemptView& v) { v.lead_m = kUnset; }, Ending::kStopped},
        Breach{"by_attacker", [](AttemptView& v) { v.contact = ContactCause::kAttacker; },
               Ending::kContactByAttacker},
        Breach{"by_defender", [](AttemptView& v) { v.contact = ContactCause::kDefender; },
               Ending::kContactByDefender},
        Breach{"shared", [](AttemptView& v) { v.contact = ContactCause::kShared; },
               Ending::kContactShared},
        Breach{"contact_before_stop",
               [](AttemptView& v) {
                 v.stopped = true;
                 v.contact = ContactCause::kDefender;
               },
               Ending::kContactByDefender}),
    [](const testing::TestParamInfo<Breach>& breach) { return breach.param.name; });

TEST(Attempt, AnEndingStays) {
  Judged run = judged({});
  AttemptView crash = run.last;
  crash.contact = ContactCause::kAttacker;
  EXPECT_EQ(step({}, kRound_mps, kTrack_m, run.state, crash).ending, Ending::kPassed);
}

TEST(Attempt, EveryEndingHasItsNameAndReason) {
  for (int i = 0; i <= static_cast<int>(Ending::kContactShared); ++i) {
    const auto ending = static_cast<Ending>(i);
    EXPECT_EQ(ending_named(name_of(ending)), ending);
    EXPECT_GT(std::string(reason_of(ending)).size(), 10U);
  }
  EXPECT_FALSE(ending_named("won"));
}

}  // namespace
}  // namespace pitwall::rules
