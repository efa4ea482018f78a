// SPDX-License-Identifier: Apache-2.0
#include "vehicle/autonomy/planning/race.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/support/allocation_guard.hpp"
#include "tests/vehicle/autonomy/planning/race_rig.hpp"

namespace pitwall::planning {
namespace {

using testing::RaceRig;
using world::TrackFlag;
using world::VehicleFlag;

constexpr double kSlow_mps = 36.0;

// Ticks with these flags; the phases in their order.
std::vector<PassPhase> drive(RaceRig& rig, int ticks, TrackFlag flag,
                             VehicleFlag role = VehicleFlag::kAttacker) {
  std::vector<PassPhase> phases{rig.state.pass.phase};
  for (int i = 0; i < ticks; ++i) {
    rig.tick(flag, role, kSlow_mps);
    if (phases.back() != rig.state.pass.phase) phases.push_back(rig.state.pass.phase);
    EXPECT_TRUE(rig.beside_m() > 2.5 || std::abs(rig.gap_m()) > 8.0) << rig.now.ns;
  }
  return phases;
}

TEST(Race, TheAttackerTrailsOnGreenAndPassesOnWavingGreen) {
  using enum PassPhase;
  RaceRig rig;
  EXPECT_EQ(drive(rig, 800, TrackFlag::kGreen), (std::vector{kFree, kTrail}));
  EXPECT_NEAR(rig.gap_m(), -25.0, 1.0);
  EXPECT_NEAR(rig.speed_mps, rig.other_mps, 0.3);
  EXPECT_EQ(drive(rig, 600, TrackFlag::kWavingGreen), (std::vector{kTrail, kPass, kAhead, kFree}));
  EXPECT_GT(rig.gap_m(), 30.0);
  EXPECT_NEAR(rig.n_m, 3.0, 0.1) << "the door is closed";
  EXPECT_NEAR(rig.speed_mps, kSlow_mps, 0.1);
}

TEST(Race, ThePublishedPrimitivesPassWhereNothingIsNoisy) {
  RaceRig rig(PassLaw::kPaper);
  drive(rig, 600, TrackFlag::kGreen);
  EXPECT_NEAR(rig.gap_m(), -25.0, 2.0);
  drive(rig, 600, TrackFlag::kWavingGreen);
  EXPECT_GT(rig.gap_m(), 30.0);
  EXPECT_NEAR(rig.n_m, 3.0, 0.1) << "the door is closed";
}

TEST(Race, NobodyPassesWithoutTheRight) {
  for (const auto& [flag, role] : {std::pair{TrackFlag::kGreen, VehicleFlag::kAttacker},
                                   std::pair{TrackFlag::kWavingGreen, VehicleFlag::kDefender},
                                   std::pair{TrackFlag::kWavingGreen, VehicleFlag::kNone},
                                   std::pair{TrackFlag::kYellow, VehicleFlag::kAttacker}}) {
    RaceRig rig;
    rig.other_mps = 30.0;
    drive(rig, 800, flag, role);
    EXPECT_LT(rig.gap_m(), -10.0);
    EXPECT_EQ(rig.state.line, 0u);
  }
}

// The most restrictive reading, at any moment of a pass: who is not well ahead falls behind.
TEST(Race, AFlagThatFallsInAPassEndsItWhereverTheCarIs) {
  RaceRig passing;
  drive(passing, 600, TrackFlag::kGreen);
  for (int moment = 0; moment < 8; ++moment) {
    drive(passing, 30, TrackFlag::kWavingGreen);
    RaceRig rig = passing;
    const double gap_m = rig.gap_m();
    drive(rig, 350, TrackFlag::kGreen);
    EXPECT_EQ(rig.state.line, 0u) << gap_m;
    if (gap_m < 14.0) {
      EXPECT_LT(rig.gap_m(), -12.0) << gap_m;
    }
    if (gap_m > 18.0) {
      EXPECT_GT(rig.gap_m(), 25.0) << gap_m;
    }
  }
}

TEST(Race, TheOperatorsLimitHoldsInAPass) {
  RaceRig rig;
  drive(rig, 800, TrackFlag::kGreen);
  rig.operator_limit_mps = 37.0;
  for (int i = 0; i < 600; ++i) {
    rig.tick(TrackFlag::kWavingGreen, VehicleFlag::kAttacker, kSlow_mps);
    ASSERT_LE(rig.speed_mps, 37.3);
  }
  EXPECT_EQ(rig.state.pass.bar, PassBar::kTooSlow);
  EXPECT_LT(rig.gap_m(), -15.0);
}

TEST(Race, ACarThatStandsInTheWayIsMetStanding) {
  for (const double n_m : {3.0, 1.5, 4.4}) {
    RaceRig rig;
    rig.other_n_m = n_m, rig.other_mps = 0.0, rig.other_s_m = 500.0, rig.speed_mps = 40.0;
    for (int i = 0; i < 800; ++i) rig.tick(TrackFlag::kGreen, VehicleFlag::kNone, 40.0);
    EXPECT_LT(rig.speed_mps, 0.5);
    EXPECT_LT(rig.gap_m(), -5.0);
  }
}

TEST(Race, ACarBesideTheWayIsPassedOnTheOwnLine) {
  RaceRig rig;
  rig.other_n_m = -3.0, rig.other_mps = 20.0, rig.other_s_m = 200.0;
  for (int i = 0; i < 400; ++i) rig.tick(TrackFlag::kGreen, VehicleFlag::kNone, 40.0);
  EXPECT_GT(rig.gap_m(), 50.0);
  EXPECT_EQ(rig.state.line, 0u);
}

// Early the car stays behind; later the way out is ahead.
TEST(Race, ARivalThatMovesIntoTheLineEndsThePassWhileBrakingKeepsUsBehind) {
  RaceRig rig;
  drive(rig, 800, TrackFlag::kGreen);
  while (rig.gap_m() < -24.0) rig.tick(TrackFlag::kWavingGreen, VehicleFlag::kAttacker, kSlow_mps);
  rig.other_drift_mps = -1.2;
  bool gave_way = false;
  for (int i = 0; i < 160; ++i) {
    if (rig.other_n_m < -3.0) rig.other_drift_mps = 0.0;
    rig.tick(TrackFlag::kWavingGreen, VehicleFlag::kAttacker, kSlow_mps);
    ASSERT_TRUE(rig.beside_m() > 2.2 || std::abs(rig.gap_m()) > 6.0)
        << rig.gap_m() << " " << rig.beside_m();
    gave_way = gave_way || rig.state.pass.phase == PassPhase::kYield;
  }
  EXPECT_TRUE(gave_way) << "and passes on the line that the rival has left";

  RaceRig beside;
  drive(beside, 800, TrackFlag::kGreen);
  while (beside.gap_m() < -10.0)
    beside.tick(TrackFlag::kWavingGreen, VehicleFlag::kAttacker, kSlow_mps);
  beside.other_drift_mps = -1.0;
  for (int i = 0; i < 160; ++i) {
    if (beside.other_n_m < -3.0) beside.other_drift_mps = 0.0;
    beside.tick(TrackFlag::kWavingGreen, VehicleFlag::kAttacker, kSlow_mps);
    ASSERT_TRUE(beside.beside_m() > 2.2 || std::abs(beside.gap_m()) > 6.0) << beside.gap_m();
  }
  EXPECT_GT(beside.gap_m(), 6.0);
}

// Behind flags a slower car is met gently and followed; none is overtaken, but one that stands.
TEST(Race, BehindFlagsACarAheadIsFollowedAndNotOvertaken) {
  for (const double n_m : {3.0, -3.0}) {
    RaceRig rig;
    rig.other_n_m = n_m, rig.other_mps = 15.0, rig.other_s_m = 320.0, rig.speed_mps = 22.0;
    double last_mps = rig.speed_mps;
    for (int i = 0; i < 1200; ++i) {
      rig.tick(TrackFlag::kYellow, VehicleFlag::kNone, 60.0);
      EXPECT_LE((last_mps - rig.speed_mps) / 0.05, rig.params.comfort.decel_max_mps2 + 0.01) << i;
      EXPECT_LE((rig.speed_mps - last_mps) / 0.05, rig.params.comfort.accel_max_mps2 + 0.01) << i;
      ASSERT_LT(rig.gap_m(), -testing::pass_params().trail_gap_m + 3.0) << i;
      last_mps = rig.speed_mps;
    }
    EXPECT_NEAR(rig.gap_m(), -testing::pass_params().trail_gap_m, 1.0);
    EXPECT_NEAR(rig.speed_mps, 15.0, 0.2);
  }
  RaceRig rig;
  rig.other_n_m = -3.0, rig.other_mps = 0.0, rig.other_s_m = 320.0, rig.speed_mps = 22.0;
  for (int i = 0; i < 400; ++i) rig.tick(TrackFlag::kYellow, VehicleFlag::kNone, 60.0);
  EXPECT_GT(rig.gap_m(), 50.0);
}

// Another role than the attacker's, at any moment of a pass, is the same as no right to pass.
TEST(Race, ARoleThatChangesInAPassEndsIt) {
  for (const VehicleFlag role : {VehicleFlag::kDefender, VehicleFlag::kNone, VehicleFlag::kBlue}) {
    RaceRig rig;
    drive(rig, 600, TrackFlag::kGreen);
    while (rig.gap_m() < -8.0) rig.tick(TrackFlag::kWavingGreen, VehicleFlag::kAttacker, kSlow_mps);
    drive(rig, 400, TrackFlag::kWavingGreen, role);
    EXPECT_LT(rig.gap_m(), -10.0);
    EXPECT_EQ(rig.state.line, 0u);
    EXPECT_EQ(rig.state.pass.phase, PassPhase::kTrail);
  }
}

TEST(Race, ALineChangeGoesOnWithPlaceDirectionAndCurvature) {
  RaceRig rig;
  const Line &from = rig.own, &to = rig.others[0];
  const OffsetChange merge{.from_s_m = 500.0, .length_m = 200.0, .from_m = 1.0, .to_m = -2.0};
  for (double s_m = 300.0; s_m < 800.0; s_m += 23.0) {
    const Beside before = beside(from.at(s_m), offset_at(from, merge, s_m));
    const OffsetChange change = change_line(from, merge, s_m, to, 150.0);
    const Beside after = beside(to.at(change.from_s_m), offset_at(to, change, change.from_s_m));
    EXPECT_NEAR(std::hypot(after.x_m - before.x_m, after.y_m - before.y_m), 0.0, 1e-3) << s_m;
    EXPECT_NEAR(wrap_pi(after.yaw_rad - before.yaw_rad), 0.0, 1e-6) << s_m;
    EXPECT_NEAR(after.curvature_per_m, before.curvature_per_m, 1e-6) << s_m;
    const double end_m = change.from_s_m + 151.0;
    EXPECT_EQ(offset_at(to, change, end_m).n_m, 0.0);
  }
}

// At the speed that the line allows in its turn a merge takes longer, so that the turn carries it;
// on the straight, and for a slow car, it does not.
TEST(Race, AMergeThatIsInNoHurryIsLongerInACorner) {
  const world::TrackMap track = testing::stadium(120.0);
  LineParams inside = testing::kParams.line, outside = inside;
  inside.offset_m = 3.0, outside.offset_m = -3.0;
  const Line from = build_line(track, outside).value(), to = build_line(track, inside).value();
  const envelope::FrictionParams& friction = testing::kParams.line.friction;
  const DriveLimits limits{.target_mps = 0.0,
                           .pace = testing::kParams.racing,
                           .corners = testing::kParams.racing,
                           .friction = on_tyres(friction, 85.0),
                           .grip_share = testing::kParams.line.grip_share,
                           .tyres = world::place_of(friction.tyres, 85.0),
                           .steering = nullptr};
  constexpr double kLength_m = 160.0;
  int longer = 0, as_long = 0;
  for (double s_m = 0.0; s_m < from.length_m; s_m += 25.0) {
    EXPECT_EQ(unhurried_m(from, {}, s_m, to, kLength_m, 30.0, limits), kLength_m) << s_m;
    const double limit_mps = to.at(s_m).speed_mps.back();
    const double chosen_m = unhurried_m(from, {}, s_m, to, kLength_m, limit_mps, limits);
    EXPECT_GE(chosen_m, kLength_m) << s_m;
    EXPECT_LE(chosen_m, 3.0 * kLength_m) << s_m;
    ++(chosen_m > kLength_m ? longer : as_long);
  }
  EXPECT_GT(longer, 3);
  EXPECT_GT(as_long, 3);
}

Reason reason_after(RaceRig& rig, int ticks, TrackFlag flag) {
  Reason reason = Reason::kUnknown;
  for (int i = 0; i < ticks; ++i) reason = rig.tick(flag, VehicleFlag::kAttacker, kSlow_mps).reason;
  return reason;
}

TEST(Race, AnAttemptWithoutFuelIsDeclinedBeforeItsWavingGreen) {
  for (const auto fuel : {rules::FuelState::kNoAttempt, rules::FuelState::kHomeNow}) {
    RaceRig rig;
    drive(rig, 400, TrackFlag::kGreen);
    EXPECT_EQ(rig.state.pass.attempt, AttemptChoice::kOpen);
    rig.fuel = fuel;
    EXPECT_EQ(reason_after(rig, 1, TrackFlag::kGreen), Reason::kDeclined);
    EXPECT_EQ(rig.state.pass.attempt, AttemptChoice::kDeclined);
    rig.fuel = rules::FuelState::kEnough;
    EXPECT_EQ(reason_after(rig, 200, TrackFlag::kWavingGreen), Reason::kDeclined) << "it stays so";
    EXPECT_LT(rig.gap_m(), -12.0);
    // WHEN the attempt is over, the next one is another matter
    drive(rig, 1, TrackFlag::kGreen, VehicleFlag::kDefender);
    EXPECT_EQ(rig.state.pass.attempt, AttemptChoice::kOpen);
    drive(rig, 400, TrackFlag::kGreen);
    EXPECT_EQ(drive(rig, 500, TrackFlag::kWavingGreen).back(), PassPhase::kFree);
    EXPECT_GT(rig.gap_m(), 30.0);
  }
}

TEST(Race, WavingGreenAndNoFuelInTheSameTickIsDeclined) {
  RaceRig rig;
  drive(rig, 800, TrackFlag::kGreen);
  rig.fuel = rules::FuelState::kNoAttempt;
  EXPECT_EQ(reason_after(rig, 600, TrackFlag::kWavingGreen), Reason::kDeclined);
  EXPECT_LT(rig.gap_m(), -12.0);
}

TEST(Race, AnAttemptThatHasBegunIsFinished) {
  RaceRig rig;
  drive(rig, 800, TrackFlag::kGreen);
  drive(rig, 1, TrackFlag::kWavingGreen);
  EXPECT_EQ(rig.state.pass.attempt, AttemptChoice::kCommitted);
  rig.fuel = rules::FuelState::kNoAttempt;
  drive(rig, 600, TrackFlag::kWavingGreen);
  EXPECT_GT(rig.gap_m(), 30.0);
  EXPECT_NEAR(rig.n_m, 3.0, 0.1) << "the door is closed";
}

// The way home is worth more than the attempt, at any moment of it.
TEST(Race, WithFuelForTheWayHomeNobodyRaces) {
  RaceRig passing;
  drive(passing, 400, TrackFlag::kGreen);
  for (int moment = 0; moment < 4; ++moment) {
    drive(passing, 60, TrackFlag::kWavingGreen);
    RaceRig rig = passing;
    rig.fuel = rules::FuelState::kHomeNow;
    // Its rival drives on, through what is in its way.
    EXPECT_EQ(reason_after(rig, 300, TrackFlag::kWavingGreen), Reason::kDeclined);
    EXPECT_LE(rig.speed_mps, rig.params.caution_speed_mps + 0.1);
  }
  RaceRig defends;
  defends.fuel = rules::FuelState::kHomeNow;
  Reason reason = Reason::kUnknown;
  for (int i = 0; i < 400; ++i)
    reason = defends.tick(TrackFlag::kGreen, VehicleFlag::kDefender, kSlow_mps).reason;
  EXPECT_EQ(reason, Reason::kFuelHome);
  EXPECT_LE(defends.speed_mps, defends.params.caution_speed_mps + 0.1);
}

TEST(Race, PlanningAmongCarsDoesNotAllocate) {
  RaceRig rig;
  drive(rig, 800, TrackFlag::kGreen);
  for (int i = 0; i < 300; ++i) {
    const auto tick = [&] { rig.tick(TrackFlag::kWavingGreen, VehicleFlag::kAttacker, kSlow_mps); };
    ASSERT_EQ(pitwall::testing::allocations_of(tick), 0u);
  }
}

}  // namespace
}  // namespace pitwall::planning
