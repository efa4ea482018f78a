// SPDX-License-Identifier: Apache-2.0
#include "protocol/rules/match.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

namespace pitwall::rules {
namespace {

static_assert(std::is_trivially_copyable_v<Match>);

constexpr std::array kAll{Ending::kPassed,
                          Ending::kOutOfLaps,
                          Ending::kNotClosedUp,
                          Ending::kDeclined,
                          Ending::kEarly,
                          Ending::kCutIn,
                          Ending::kDoorOpen,
                          Ending::kDefenderLeftLane,
                          Ending::kDefenderSpeed,
                          Ending::kStopped,
                          Ending::kContactByAttacker,
                          Ending::kContactByDefender,
                          Ending::kContactShared};

auto key_of(const Match& m) {
  return std::tuple{m.attacker, m.round, m.second, m.first_passed, m.repeats, m.result, m.winner};
}

// Every match that some sequence of endings leads to, with the number of attempts of the longest
// way there; a match that could come back to an earlier state would never end this search, which
// the bound of its depth shows.
class Reached {
 public:
  Reached(const PassingRules& rules, std::uint8_t first) : rules_(rules) {
    follow(begin_match(first), 0);
  }
  std::vector<Match> matches() const {
    std::vector<Match> all;
    for (const auto& [key, at] : at_) all.push_back(at.first);
    return all;
  }
  std::size_t longest() const {
    std::size_t longest = 0;
    for (const auto& [key, at] : at_) longest = std::max(longest, at.second);
    return longest;
  }

 private:
  void follow(const Match& match, std::size_t attempts) {
    ASSERT_LE(attempts, kAttemptsMax);
    auto [at, is_new] = at_.try_emplace(key_of(match), match, attempts);
    if (!is_new && attempts <= at->second.second) return;
    at->second.second = attempts;
    if (match.result != Result::kOpen) return;
    for (const Ending ending : kAll) follow(record(rules_, match, ending), attempts + 1);
  }

  const PassingRules& rules_;
  std::map<decltype(key_of(Match{})), std::pair<Match, std::size_t>> at_;
};

Match exchanged(Match match) {
  match.attacker = match.attacker == 0 ? 1 : 0;
  if (match.result == Result::kWon) match.winner = match.winner == 0 ? 1 : 0;
  return match;
}

class EveryMatch : public testing::TestWithParam<std::tuple<std::uint8_t, std::uint8_t>> {
 protected:
  PassingRules rules_ = [] {
    PassingRules rules;
    rules.repeats = std::get<1>(GetParam());
    return rules;
  }();
  Reached reached_{rules_, std::get<0>(GetParam())};
};

TEST_P(EveryMatch, EndsAfterAsManyAttemptsAsItsRoundsAndRepeatsAllow) {
  const std::size_t rounds = rules_.round_speeds_mph.size();
  EXPECT_EQ(reached_.longest(), rounds * kCars * (1U + rules_.repeats));
  EXPECT_LE(reached_.longest(), kAttemptsMax);
}

TEST_P(EveryMatch, HasAnAssignmentUntilItHasAResult) {
  for (const Match& match : reached_.matches())
    EXPECT_EQ(due(rules_, match).has_value(), match.result == Result::kOpen);
}

TEST_P(EveryMatch, KnowsOfAFirstPassOnlyWhereTheSecondIsDue) {
  for (const Match& match : reached_.matches()) EXPECT_TRUE(match.second || !match.first_passed);
}

TEST_P(EveryMatch, SwapsRolesAfterEveryAttemptThatCounts) {
  for (const Match& match : reached_.matches()) {
    if (match.result != Result::kOpen) continue;
    for (const Ending ending : kAll) {
      const Match next = record(rules_, match, ending);
      if (next.result != Result::kOpen) continue;
      const bool repeated = score_of(rules_, ending, match.repeats) == Score::kRepeated;
      EXPECT_EQ(next.attacker == match.attacker, repeated) << name_of(ending);
    }
  }
}

TEST_P(EveryMatch, OnlyRaisesTheRoundSpeedAndOnlyAfterTwoPasses) {
  for (const Match& match : reached_.matches()) {
    if (match.result != Result::kOpen) continue;
    for (const Ending ending : kAll) {
      const Match next = record(rules_, match, ending);
      const auto before = due(rules_, match), after = due(rules_, next);
      if (!after) continue;
      EXPECT_GE(after->round_speed_mph, before->round_speed_mph);
      const bool rises = after->round_speed_mph > before->round_speed_mph;
      const bool passed = score_of(rules_, ending, match.repeats) == Score::kPassed;
      EXPECT_EQ(rises, match.second && match.first_passed && passed) << name_of(ending);
    }
  }
}

TEST_P(EveryMatch, ExchangesItsResultWithTheCars) {
  for (const Match& match : reached_.matches()) {
    if (match.result != Result::kOpen) continue;
    for (const Ending ending : kAll)
      EXPECT_EQ(record(rules_, exchanged(match), ending), exchanged(record(rules_, match, ending)));
  }
}

TEST_P(EveryMatch, IsWonByTheCarThatPassedWhereTheOtherDidNot) {
  for (const Match& match : reached_.matches()) {
    if (match.result != Result::kOpen || !match.second) continue;
    for (const Ending ending : kAll) {
      const Score score = score_of(rules_, ending, match.repeats);
      const Match next = record(rules_, match, ending);
      if (score == Score::kMatchOver || score == Score::kRepeated) continue;
      const bool passed = score == Score::kPassed;
      const bool last = match.round + 1U == rules_.round_speeds_mph.size();
      const Result expected = passed != match.first_passed ? Result::kWon
                              : passed && !last            ? Result::kOpen
                                                           : Result::kDraw;
      ASSERT_EQ(next.result, expected) << name_of(ending);
      if (expected == Result::kWon) {
        EXPECT_EQ(next.winner == match.attacker, passed);
      }
    }
  }
}

TEST_P(EveryMatch, IsLostByTheCarThatCausedAContactAlone) {
  for (const Match& match : reached_.matches()) {
    if (match.result != Result::kOpen) continue;
    const Match by_attacker = record(rules_, match, Ending::kContactByAttacker);
    const Match by_defender = record(rules_, match, Ending::kContactByDefender);
    EXPECT_EQ(by_attacker.result, Result::kWon);
    EXPECT_NE(by_attacker.winner, match.attacker);
    EXPECT_EQ(by_defender.result, Result::kWon);
    EXPECT_EQ(by_defender.winner, match.attacker);
    EXPECT_EQ(record(rules_, match, Ending::kContactShared).result, Result::kDraw);
  }
}

TEST_P(EveryMatch, CountsADeclinedAttemptAsAFailedOne) {
  for (const Match& match : reached_.matches()) {
    if (match.result != Result::kOpen) continue;
    EXPECT_EQ(record(rules_, match, Ending::kDeclined), record(rules_, match, Ending::kOutOfLaps));
  }
}

INSTANTIATE_TEST_SUITE_P(All, EveryMatch,
                         testing::Combine(testing::Values<std::uint8_t>(0, 1),
                                          testing::Values<std::uint8_t>(0, 1, kRepeatsMax)));

// The sequence of the paper's last day: both pass at 80, 100, 115 and 125 mph, none at 135.
TEST(Match, PlaysThePapersLastDay) {
  const PassingRules rules;
  Match match = begin_match(0);
  std::vector<double> speeds_mph;
  while (const auto next = due(rules, match)) {
    speeds_mph.push_back(next->round_speed_mph);
    match =
        record(rules, match, next->round_speed_mph < 135.0 ? Ending::kPassed : Ending::kOutOfLaps);
  }
  EXPECT_EQ(speeds_mph, (std::vector<double>{80, 80, 100, 100, 115, 115, 125, 125, 135, 135}));
  EXPECT_EQ(match.result, Result::kDraw);
}

TEST(Match, RepeatsAnAttemptThatTheDefenderSpoiledOnceAndThenGrantsIt) {
  const PassingRules rules;
  for (const Ending ending : {Ending::kDefenderSpeed, Ending::kDefenderLeftLane}) {
    const Match again = record(rules, begin_match(0), ending);
    EXPECT_EQ(again.attacker, 0);
    EXPECT_EQ(again.repeats, 1);
    const Match granted = record(rules, again, ending);
    EXPECT_TRUE(granted.first_passed);
    EXPECT_EQ(granted.repeats, 0);
  }
  const Match stopped = record(rules, begin_match(0), Ending::kStopped);
  EXPECT_FALSE(record(rules, stopped, Ending::kStopped).first_passed);
}

TEST(Match, RoundSpeedsAreThoseOfTheCompetition) {
  const RoundSpeeds speeds_mph = standard_rounds_mph();
  EXPECT_EQ(std::vector<double>(speeds_mph.begin(), speeds_mph.end()),
            (std::vector<double>{80, 100, 115, 125, 135, 150}));
  EXPECT_TRUE(std::ranges::is_sorted(speeds_mph, std::less_equal<>{}));
}

}  // namespace
}  // namespace pitwall::rules
