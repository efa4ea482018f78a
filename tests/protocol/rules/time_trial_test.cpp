// SPDX-License-Identifier: Apache-2.0
#include "protocol/rules/time_trial.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

namespace pitwall::rules {
namespace {

TimeTrial of(std::vector<double> first_mps, std::vector<double> second_mps) {
  TimeTrial trial;
  for (const double mps : first_mps) trial = with_lap(trial, 0, mps);
  for (const double mps : second_mps) trial = with_lap(trial, 1, mps);
  return trial;
}

TEST(TimeTrial, IsTheMeanOfTheFastestLapOfEachRun) {
  EXPECT_DOUBLE_EQ(*score_mps(of({60.0, 70.0, 65.0}, {74.0, 50.0})), 72.0);
}

TEST(TimeTrial, DoesNotDependOnTheOrderOfTheLaps) {
  std::vector<double> laps_mps{51.0, 62.0, 63.0, 70.0};
  do {
    EXPECT_EQ(of(laps_mps, {60.0}), of({70.0}, {60.0}));
  } while (std::ranges::next_permutation(laps_mps).found);
}

TEST(TimeTrial, HasNoScoreWithoutALapInBothRuns) {
  EXPECT_FALSE(score_mps(of({60.0}, {})));
  EXPECT_FALSE(score_mps(of({}, {60.0})));
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(score_mps(of({60.0}, {kUnset, kInfinity, 0.0, -3.0})));
}

TEST(TimeTrial, RanksACarWithAScoreAboveOneWithoutAndNeverBothAboveEachOther) {
  const std::vector trials{of({}, {}), of({60.0}, {}), of({60.0}, {70.0}), of({65.0}, {65.0}),
                           of({60.0}, {71.0})};
  for (const TimeTrial& a : trials)
    for (const TimeTrial& b : trials) {
      EXPECT_FALSE(better(a, b) && better(b, a));
      EXPECT_EQ(better(a, b), score_mps(a).value_or(0.0) > score_mps(b).value_or(0.0));
    }
}

TEST(TimeTrial, DecidesOnlyADraw) {
  const TimeTrial fast = of({70.0}, {70.0}), slow = of({60.0}, {60.0});
  Match match = begin_match(0);
  EXPECT_FALSE(advancing(match, {slow, fast}));
  match.result = Result::kDraw;
  EXPECT_EQ(advancing(match, {slow, fast}), 1);
  EXPECT_EQ(advancing(match, {fast, slow}), 0);
  EXPECT_FALSE(advancing(match, {fast, fast}));
  match.result = Result::kWon, match.winner = 1;
  EXPECT_EQ(advancing(match, {fast, slow}), 1);
}

}  // namespace
}  // namespace pitwall::rules
