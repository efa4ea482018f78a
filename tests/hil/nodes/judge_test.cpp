// SPDX-License-Identifier: Apache-2.0
#include "hil/nodes/judge.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <type_traits>
#include <vector>

#include "hil/traffic/ghost_builder.hpp"
#include "hil/traffic/ghost_driver.hpp"
#include "hil/traffic/motion_trace.hpp"
#include "hil/traffic/rectangle.hpp"
#include "tests/hil/traffic/oval.hpp"

namespace pitwall::race {
namespace {

using rules::Ending;
using traffic::Defence;
using traffic::Manner;

static_assert(std::is_trivially_copyable_v<JudgeState>);

constexpr Duration kTick = milliseconds(10);
constexpr double kStart_mps = 30.0, kInside_m = 3.5, kOutside_m = -3.5;

struct Driver {
  Manner manner = Manner::kPass;
  Defence defence = Defence::kHold;
  double start_s_m = 0.0;
};

using Watch = std::function<void(const JudgeState& before, const JudgeState& after,
                                 const JudgeView& view, Instant now)>;
using Change = std::function<void(JudgeView& view, Instant now)>;

// Two ghosts on the oval, as they drive by what the judge has them shown.
class Track {
 public:
  Track(const std::array<Driver, rules::kCars>& drivers, JudgeParams params)
      : drivers_(drivers), params_(std::move(params)) {
    params_.track_length_m = traffic::oval().length_m();
    state_ = begin_judging(params_);
    for (std::size_t car = 0; car < rules::kCars; ++car) {
      traffic::GhostPlan plan;
      plan.start_s_m = drivers[car].start_s_m, plan.start_mps = kStart_mps;
      plan.line.offset_m = kInside_m, plan.speed.mps = kStart_mps;
      plan.lanes = {.inside_m = kInside_m, .outside_m = kOutside_m};
      auto ghost = traffic::build_ghost(plan, traffic::oval(), nullptr);
      if (!ghost) ADD_FAILURE() << to_string(ghost.error());
      ghosts_[car] = *std::move(ghost);
      cars_[car] = traffic::begin(ghosts_[car], traffic::oval(), Instant{});
    }
  }

  const JudgeState& drive(Duration at_most, const Watch& watch = {}, const Change& change = {}) {
    for (Instant now{}; now - Instant{} < at_most && state_.stage != Stage::kOver; now += kTick)
      step(now, watch, change);
    return state_;
  }

 private:
  void step(Instant now, const Watch& watch, const Change& change) {
    JudgeView view{.cars = {judged(0), judged(1)}, .contact = contact()};
    if (change) change(view, now);
    const JudgeState before = state_;
    state_ = race::step(params_, before, view, now);
    if (watch) watch(before, state_, view, now);
    move(now);
  }

  void move(Instant now) {
    const std::array poses{cars_[0].pose, cars_[1].pose};
    for (std::uint8_t car = 0; car < rules::kCars; ++car) {
      traffic::Surroundings around;
      if (const auto shown = shown_to(state_, car)) {
        const traffic::CarPose &own = poses[car], &other = poses[1U - car];
        const traffic::DriverOrder order = traffic::order_of(
            drivers_[car].manner, drivers_[car].defence,
            {.role = car == state_.match.attacker ? rules::Role::kAttacker : rules::Role::kDefender,
             .is_cautioned = shown->flags.vehicle == world::VehicleFlag::kYellow,
             .pass_allowed = shown->flags.track == world::TrackFlag::kWavingGreen,
             .round_speed_mps = from_mph(shown->round_speed_mph),
             .lead_m = std::remainder(own.s_m - other.s_m, params_.track_length_m),
             .length_m = own.length_m,
             .other_mps = traffic::speed_mps(other),
             .is_inside = own.n_m > 0.0,
             .is_other_inside = other.n_m > 0.0});
        around.order = {.inside = order.inside, .speed_mps = order.speed_mps};
        declines_[car] = order.declines;
      }
      cars_[car] = traffic::step(ghosts_[car], traffic::oval(), cars_[car], around, now + kTick);
    }
  }

  JudgedCar judged(std::size_t car) const {
    const traffic::CarPose& pose = cars_[car].pose;
    return {.station_m = pose.s_m,
            .speed_mps = traffic::speed_mps(pose),
            .length_m = pose.length_m,
            .inside = pose.n_m > 0.0,
            .declines = declines_[car]};
  }

  // Whoever is behind drove into the other one.
  std::optional<JudgedContact> contact() const {
    const traffic::CarPose &a = cars_[0].pose, &b = cars_[1].pose;
    if (std::hypot(a.x_m - b.x_m, a.y_m - b.y_m) > 10.0) return std::nullopt;
    const auto gap = traffic::gap_between(traffic::rectangle_of(a), traffic::rectangle_of(b));
    if (gap.distance_m > 0.0) return std::nullopt;
    const bool first = std::remainder(a.s_m - b.s_m, params_.track_length_m) < 0.0;
    return JudgedContact{.caused = {first, !first}};
  }

  std::array<Driver, rules::kCars> drivers_;
  JudgeParams params_;
  JudgeState state_;
  std::array<traffic::Ghost, rules::kCars> ghosts_;
  std::array<traffic::GhostState, rules::kCars> cars_;
  std::array<bool, rules::kCars> declines_{};
};

constexpr Driver kAhead{.start_s_m = 100.0}, kBehind{.start_s_m = 40.0};

Driver with(Driver driver, Manner manner, Defence defence = Defence::kHold) {
  driver.manner = manner;
  driver.defence = defence;
  return driver;
}

// One round, in which the first car attacks first.
JudgeParams one_round(double speed_mph) {
  JudgeParams params;
  params.rules.round_speeds_mph.clear();
  EXPECT_TRUE(params.rules.round_speeds_mph.push(speed_mph));
  return params;
}

TEST(Judge, TwoCarsThatPassAtEveryRoundSpeedDraw) {
  Track track({kBehind, kAhead}, {});
  const JudgeState& end = track.drive(seconds(3600));
  EXPECT_EQ(end.match.result, rules::Result::kDraw);
  ASSERT_EQ(end.attempts.size(), rules::kRoundSpeeds_mph.size() * rules::kCars);
  for (std::size_t i = 0; i < end.attempts.size(); ++i) {
    const AttemptRecord& attempt = end.attempts[i];
    EXPECT_EQ(attempt.ending, Ending::kPassed) << i << " " << rules::name_of(attempt.ending);
    EXPECT_EQ(attempt.assignment.attacker, i % rules::kCars);
    EXPECT_EQ(attempt.assignment.round_speed_mph, rules::kRoundSpeeds_mph[i / rules::kCars]);
    EXPECT_LT(attempt.laps_used, 3.0);
    EXPECT_LT(attempt.green, attempt.waving);
    EXPECT_LT(attempt.waving, attempt.clear);
    EXPECT_LE(attempt.clear, attempt.ended);
    EXPECT_NEAR(attempt.defender_least_mps, from_mph(attempt.assignment.round_speed_mph), 0.5);
    EXPECT_NEAR(attempt.defender_most_mps, from_mph(attempt.assignment.round_speed_mph), 0.5);
  }
}

struct Case {
  const char* name;
  Manner manner;
  Defence defence;
  Ending ending;
};

class EndingOf : public testing::TestWithParam<std::tuple<Case, double>> {};

TEST_P(EndingOf, IsSeenByTheJudge) {
  const auto& [c, speed_mph] = GetParam();
  Track track({with(kBehind, c.manner), with(kAhead, Manner::kPass, c.defence)},
              one_round(speed_mph));
  const JudgeState& end =
      track.drive(seconds(3000), [&](const JudgeState&, const JudgeState& now, const JudgeView&,
                                     Instant) { EXPECT_NE(now.stage, Stage::kWaiting); });
  ASSERT_FALSE(end.attempts.empty());
  EXPECT_EQ(rules::name_of(end.attempts[0].ending), std::string{rules::name_of(c.ending)});
}

INSTANTIATE_TEST_SUITE_P(
    Each, EndingOf,
    testing::Combine(
        testing::Values(Case{"pass", Manner::kPass, Defence::kHold, Ending::kPassed},
                        Case{"follow", Manner::kFollow, Defence::kHold, Ending::kOutOfLaps},
                        Case{"cut_in", Manner::kCutIn, Defence::kHold, Ending::kCutIn},
                        Case{"early", Manner::kEarly, Defence::kHold, Ending::kEarly},
                        Case{"ram", Manner::kRam, Defence::kHold, Ending::kContactByAttacker},
                        Case{"open_door", Manner::kOpenDoor, Defence::kHold, Ending::kDoorOpen},
                        Case{"decline", Manner::kDecline, Defence::kHold, Ending::kDeclined},
                        Case{"slow", Manner::kFollow, Defence::kSlow, Ending::kDefenderSpeed},
                        Case{"wide", Manner::kFollow, Defence::kWide, Ending::kDefenderLeftLane}),
        testing::Values(80.0, 150.0)),
    [](const auto& each) {
      return std::string{std::get<0>(each.param).name} + "_" +
             std::to_string(static_cast<int>(std::get<1>(each.param))) + "_mph";
    });

TEST(Judge, OneOfTwoThatPassesWinsAndNoneIsADraw) {
  const auto result = [](Manner first, Manner second) {
    Track track({with(kBehind, first), with(kAhead, second)}, one_round(80.0));
    return track.drive(seconds(3000)).match;
  };
  EXPECT_EQ(result(Manner::kPass, Manner::kFollow).winner, 0);
  EXPECT_EQ(result(Manner::kPass, Manner::kFollow).result, rules::Result::kWon);
  EXPECT_EQ(result(Manner::kCutIn, Manner::kPass).winner, 1);
  EXPECT_EQ(result(Manner::kCutIn, Manner::kPass).result, rules::Result::kWon);
  EXPECT_EQ(result(Manner::kFollow, Manner::kDecline).result, rules::Result::kDraw);
}

TEST(Judge, TheSameCarsInTheOtherOrderGiveTheSameRecords) {
  JudgeParams params = one_round(100.0);
  Track one({with(kBehind, Manner::kPass), with(kAhead, Manner::kCutIn)}, params);
  params.first_attacker = 1;
  Track other({with(kAhead, Manner::kCutIn), with(kBehind, Manner::kPass)}, params);
  const JudgeState a = one.drive(seconds(3000)), b = other.drive(seconds(3000));
  ASSERT_EQ(a.attempts.size(), 2U);
  ASSERT_EQ(b.attempts.size(), 2U);
  for (std::size_t i = 0; i < a.attempts.size(); ++i) {
    EXPECT_EQ(a.attempts[i].ending, b.attempts[i].ending);
    EXPECT_EQ(a.attempts[i].ended, b.attempts[i].ended);
    EXPECT_EQ(a.attempts[i].assignment.attacker, b.attempts[i].assignment.defender);
  }
  EXPECT_NE(a.match.winner, b.match.winner);
}

TEST(Judge, AnAttackerThatIsAheadFallsBackUnderYellowOfItsOwn) {
  Track track({with(kAhead, Manner::kPass), kBehind}, one_round(80.0));
  bool formed = false;
  track.drive(seconds(300),
              [&](const JudgeState& before, const JudgeState& now, const JudgeView& view, Instant) {
                if (formed) return;
                if (now.stage == Stage::kForming) {
                  EXPECT_EQ(shown_to(now, 0)->flags,
                            (Flags{world::TrackFlag::kGreen, world::VehicleFlag::kYellow}));
                  EXPECT_EQ(shown_to(now, 1)->flags.vehicle, world::VehicleFlag::kDefender);
                }
                if (before.stage != Stage::kForming || now.stage != Stage::kAttempt || formed)
                  return;
                formed = true;
                EXPECT_GT(view.cars[1].station_m - view.cars[0].station_m, 15.0);
              });
  EXPECT_TRUE(formed);
}

TEST(Judge, CallsRaceControlOnlyWhereSomethingChanges) {
  using world::TrackFlag;
  using world::VehicleFlag;
  using Flag = std::pair<TrackFlag, VehicleFlag>;
  std::array<std::vector<Flag>, rules::kCars> flags;
  Track track({kBehind, kAhead}, one_round(80.0));
  track.drive(seconds(3000),
              [&](const JudgeState& before, const JudgeState& now, const JudgeView&, Instant at) {
                for (std::uint8_t car = 0; car < rules::kCars; ++car) {
                  const auto call = call_between(before, now, car, at);
                  if (!call) continue;
                  flags[car].emplace_back(*call->track, *call->vehicle);
                  EXPECT_EQ(call->round_target_speed_mph, 80.0);
                }
              });
  const auto expected = [](VehicleFlag first, VehicleFlag second) {
    return std::vector<Flag>{{TrackFlag::kGreen, first},
                             {TrackFlag::kWavingGreen, first},
                             {TrackFlag::kGreen, second},
                             {TrackFlag::kWavingGreen, second},
                             {TrackFlag::kChequered, VehicleFlag::kNone}};
  };
  EXPECT_EQ(flags[0], expected(VehicleFlag::kAttacker, VehicleFlag::kDefender));
  EXPECT_EQ(flags[1], expected(VehicleFlag::kDefender, VehicleFlag::kAttacker));
}

TEST(Judge, ACarThatCausesAContactIsShownBlack) {
  Track track({with(kBehind, Manner::kRam), kAhead}, one_round(80.0));
  const JudgeState& end = track.drive(seconds(3000));
  ASSERT_EQ(end.match.result, rules::Result::kWon);
  EXPECT_EQ(end.match.winner, 1);
  EXPECT_EQ(shown_to(end, 0)->flags.vehicle, world::VehicleFlag::kBlackPitIn);
  EXPECT_EQ(shown_to(end, 1)->flags.vehicle, world::VehicleFlag::kNone);
}

// Two cars at 80 mph that keep the first one, the attacker, so far ahead.
struct Convoy {
  double lead_m = -30.0, attacker_mps = from_mph(80.0), defender_mps = from_mph(80.0);

  JudgeView at(Instant now) const {
    const double way_m = from_mph(80.0) * now.seconds(), length_m = traffic::oval().length_m();
    const auto station_m = [&](double ahead_m) {
      return std::fmod(way_m + ahead_m + length_m, length_m);
    };
    return {.cars = {JudgedCar{station_m(lead_m), attacker_mps, 4.9, false, false},
                     JudgedCar{station_m(0.0), defender_mps, 4.9, true, false}},
            .contact = {}};
  }
};

using ChangeConvoy = std::function<void(double t_s, Convoy& convoy)>;

JudgeState judge_convoy(double time_s, const ChangeConvoy& change, double contact_s = 1e9,
                        JudgedContact contact = {}) {
  JudgeParams params = one_round(80.0);
  params.track_length_m = traffic::oval().length_m();
  JudgeState state = begin_judging(params);
  for (Instant now{}; now.seconds() < time_s && state.stage != Stage::kOver; now += kTick) {
    Convoy convoy;
    change(now.seconds(), convoy);
    JudgeView view = convoy.at(now);
    if (now.seconds() >= contact_s) view.contact = contact;
    state = step(params, state, view, now);
  }
  return state;
}

bool is_waving(const JudgeState& state) {
  return shown_to(state, 0)->flags.track == world::TrackFlag::kWavingGreen;
}

TEST(Judge, WavesForAnAttackerThatTrailsNearEnoughAndLongEnough) {
  const auto at_lead = [](double lead_m, double time_s) {
    return is_waving(judge_convoy(time_s, [&](double, Convoy& c) { c.lead_m = lead_m; }));
  };
  EXPECT_FALSE(at_lead(-60.0, 2.9));
  EXPECT_TRUE(at_lead(-60.0, 3.1));
  EXPECT_TRUE(at_lead(-64.8, 3.1));
  EXPECT_FALSE(at_lead(-65.0, 60.0));
}

TEST(Judge, CountsTheTimeOfTrailingAnewAfterABreak) {
  const auto broken = [](double t_s, Convoy& c) {
    if (t_s > 2.0 && t_s < 2.1) c.defender_mps = 20.0;
  };
  EXPECT_FALSE(is_waving(judge_convoy(4.9, broken)));
  EXPECT_TRUE(is_waving(judge_convoy(5.2, broken)));
}

TEST(Judge, StopsAnAttackerThatDoesNotFallBackAndCountsItTheSecondTime) {
  const JudgeState end = judge_convoy(365.0, [](double, Convoy& c) { c.lead_m = 40.0; });
  ASSERT_GE(end.attempts.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(end.attempts[i].ending, Ending::kStopped);
    EXPECT_EQ(end.attempts[i].assignment.attacker, 0);
    EXPECT_NEAR((end.attempts[i].ended - end.attempts[i].formed).seconds(), 180.0, 0.02);
  }
  EXPECT_EQ(end.attempts[0].score, rules::Score::kRepeated);
  EXPECT_EQ(end.attempts[1].score, rules::Score::kFailed);
}

TEST(Judge, DoesNotWaitForACarThatHasNoPlace) {
  const JudgeState end =
      judge_convoy(5.0, [](double t_s, Convoy& c) { c.lead_m = t_s < 1.0 ? 40.0 : kUnset; });
  ASSERT_GE(end.attempts.size(), 1U);
  EXPECT_NEAR(end.attempts[0].ended.seconds(), 1.0, 0.02);
}

TEST(Judge, AContactThatBothOrNeitherCausedIsADraw) {
  for (const bool both : {false, true})
    for (const double lead_m : {-30.0, 40.0}) {  // in an attempt, and while it forms
      const JudgeState end = judge_convoy(20.0, [&](double, Convoy& c) { c.lead_m = lead_m; }, 10.0,
                                          {.caused = {both, both}});
      EXPECT_EQ(end.match.result, rules::Result::kDraw);
      ASSERT_EQ(end.attempts.size(), 1U);
      EXPECT_EQ(end.attempts[0].ending, Ending::kContactShared);
      EXPECT_EQ(shown_to(end, 0)->flags.vehicle, world::VehicleFlag::kNone);
    }
}

TEST(Judge, WaitsForTheBeginOfTheMatch) {
  JudgeParams params = one_round(80.0);
  params.begins = Instant{} + seconds(10);
  Track track({kBehind, kAhead}, params);
  track.drive(seconds(20),
              [&](const JudgeState&, const JudgeState& after, const JudgeView&, Instant now) {
                EXPECT_EQ(shown_to(after, 0).has_value(), after.stage != Stage::kWaiting);
                EXPECT_EQ(after.stage == Stage::kWaiting, now < params.begins);
              });
}

TEST(Judge, ACarWithoutAKnownPlaceStopsTheAttempt) {
  Track track({kBehind, kAhead}, one_round(80.0));
  const JudgeState& end = track.drive(seconds(400), {}, [&](JudgeView& view, Instant now) {
    if (now > Instant{} + seconds(15)) view.cars[1].station_m = kUnset;
  });
  ASSERT_GE(end.attempts.size(), 1U);
  EXPECT_EQ(end.attempts[0].ending, Ending::kStopped);
  EXPECT_NEAR((end.attempts[0].ended - Instant{}).seconds(), 15.01, 1e-9);
}

}  // namespace
}  // namespace pitwall::race
