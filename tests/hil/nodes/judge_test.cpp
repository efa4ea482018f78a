// SPDX-License-Identifier: Apache-2.0
#include "hil/nodes/judge.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <type_traits>
#include <vector>

#include "protocol/can/av21.hpp"
#include "tests/hil/nodes/ghost_match.hpp"

namespace pitwall::race {
namespace {

using rules::Ending;

static_assert(std::is_trivially_copyable_v<JudgeState>);

TEST(Judge, TwoCarsThatPassAtEveryRoundSpeedDraw) {
  GhostMatch track({kBehind, kAhead}, {});
  const JudgeState& end = track.drive(seconds(3600));
  EXPECT_EQ(end.match.result, rules::Result::kDraw);
  ASSERT_EQ(end.attempts.size(), rules::kRoundSpeeds_mph.size() * rules::kCars);
  for (std::size_t i = 0; i < end.attempts.size(); ++i) {
    const AttemptRecord& attempt = end.attempts[i];
    EXPECT_EQ(attempt.ending, Ending::kPassed) << i << " " << rules::name_of(attempt.ending);
    EXPECT_EQ(attempt.assignment.attacker, i % rules::kCars);
    EXPECT_EQ(attempt.assignment.round_speed_mph, rules::kRoundSpeeds_mph[i / rules::kCars]);
    EXPECT_GT(attempt.laps_used, 0.1);
    EXPECT_LE(attempt.laps_used, 2.0);
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
  GhostMatch track({with(kBehind, c.manner), with(kAhead, Manner::kPass, c.defence)},
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
    GhostMatch track({with(kBehind, first), with(kAhead, second)}, one_round(80.0));
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
  GhostMatch one({with(kBehind, Manner::kPass), with(kAhead, Manner::kCutIn)}, params);
  params.first_attacker = 1;
  GhostMatch other({with(kAhead, Manner::kCutIn), with(kBehind, Manner::kPass)}, params);
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
  GhostMatch track({with(kAhead, Manner::kPass), kBehind}, one_round(80.0));
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
  GhostMatch track({kBehind, kAhead}, one_round(80.0));
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

// Of race control's frames for one car: the heartbeat moves with each, none is later than its
// period, and both systems carry what is shown, from the first frame after a change on.
class BusOfCar {
 public:
  explicit BusOfCar(std::uint8_t car) : car_(car) {}

  void follow(const JudgeState& before, const JudgeState& after, Instant now) {
    if (const auto change = call_between(before, after, car_, now)) call(state_, *change);
    const auto shown = shown_to(after, car_);
    for (Instant at = now; shown && at < now + kTick; at += milliseconds(1))
      for (const can::Frame& frame : race::step({}, state_, {}, at)) judge(frame, *shown, at);
  }
  std::size_t frames() const { return frames_; }

 private:
  void judge(const can::Frame& frame, const Shown& shown, Instant at) {
    can::av21::BaseToCarSummary summary;
    can::av21::MarelliReport1 marelli;
    if (can::av21::decode(frame, summary)) {
      const RawFlags raw = to_mylaps(shown.flags);
      EXPECT_EQ(summary.track_flag, raw.track);
      EXPECT_EQ(summary.veh_flag, raw.vehicle);
      EXPECT_EQ(summary.round_target_speed, shown.round_speed_mph);
      EXPECT_NE(summary.base_to_car_heartbeat, heartbeat_);
      heartbeat_ = summary.base_to_car_heartbeat;
      EXPECT_LE(at - last_, milliseconds(500));
      last_ = at;
      ++frames_;
    } else if (can::av21::decode(frame, marelli)) {
      const RawFlags raw = to_marelli(shown.flags, shown.round_speed_mph);
      EXPECT_EQ(marelli.marelli_track_flag, raw.track);
      EXPECT_EQ(marelli.marelli_vehicle_flag, raw.vehicle);
      ++frames_;
    }
  }

  std::uint8_t car_;
  State state_;
  double heartbeat_ = -1.0;
  Instant last_{};
  std::size_t frames_ = 0;
};

TEST(Judge, WhatIsShownIsOnTheBusOfEachCarInBothEncodings) {
  GhostMatch track({kBehind, with(kAhead, Manner::kCutIn)}, one_round(100.0));
  std::array buses{BusOfCar{0}, BusOfCar{1}};
  const JudgeState end = track.drive(
      seconds(3000),
      [&](const JudgeState& before, const JudgeState& after, const JudgeView&, Instant now) {
        for (BusOfCar& bus : buses) bus.follow(before, after, now);
      });
  EXPECT_EQ(end.attempts.size(), 2U);
  const double time_s = end.attempts[end.attempts.size() - 1].ended.seconds();
  for (const BusOfCar& bus : buses) EXPECT_GT(bus.frames(), 4.0 * time_s);
}

TEST(Judge, ACarThatCausesAContactIsShownBlack) {
  GhostMatch track({with(kBehind, Manner::kRam), kAhead}, one_round(80.0));
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

TEST(Judge, StopsTheAttemptOfACarThatStandsAndNotOfOneThatIsSlowForAMoment) {
  const auto slow_for = [](double span_s) {
    return judge_convoy(20.0, [span_s](double t_s, Convoy& c) {
      if (t_s > 5.0 && t_s < 5.0 + span_s) c.attacker_mps = 0.0;
    });
  };
  const JudgeState end = slow_for(15.0);
  ASSERT_GE(end.attempts.size(), 1U);
  EXPECT_EQ(end.attempts[0].ending, Ending::kStopped);
  EXPECT_NEAR(end.attempts[0].ended.seconds(), 10.0, 0.05);
  EXPECT_TRUE(slow_for(4.0).attempts.empty());
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
  GhostMatch track({kBehind, kAhead}, params);
  track.drive(seconds(20),
              [&](const JudgeState&, const JudgeState& after, const JudgeView&, Instant now) {
                EXPECT_EQ(shown_to(after, 0).has_value(), after.stage != Stage::kWaiting);
                EXPECT_EQ(after.stage == Stage::kWaiting, now < params.begins);
              });
}

TEST(Judge, ACarWithoutAKnownPlaceStopsTheAttempt) {
  GhostMatch track({kBehind, kAhead}, one_round(80.0));
  const JudgeState& end = track.drive(seconds(400), {}, [&](JudgeView& view, Instant now) {
    if (now > Instant{} + seconds(15)) view.cars[1].station_m = kUnset;
  });
  ASSERT_GE(end.attempts.size(), 1U);
  EXPECT_EQ(end.attempts[0].ending, Ending::kStopped);
  EXPECT_NEAR((end.attempts[0].ended - Instant{}).seconds(), 15.01, 1e-9);
}

}  // namespace
}  // namespace pitwall::race
