// SPDX-License-Identifier: Apache-2.0
#include "hil/grading/after_judge.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/hil/grading/judged.hpp"
#include "tests/support/instants.hpp"

namespace pitwall::grading {
namespace {

TEST(AfterJudge, AfterWaitsForTheTriggerAndAllowsTheLimit) {
  const Signal trigger = [](double t) { return t > 2.0 - 1e-9 && t < 2.5 ? 1.0 : 0.0; };
  for (const double answer_s : {2.0, 2.3, 3.0, 3.01}) {
    const Verdict v = judge(
        reaction(seconds(1)), [&](double t) { return t > answer_s - 1e-9 ? 1.0 : 0.0; }, 10.0,
        trigger);
    EXPECT_EQ(v.pass, answer_s <= 3.0) << answer_s;
    EXPECT_EQ(v.triggers, 1U);
  }
}

TEST(AfterJudge, AfterFailsWhenTheTriggerNeverComes) {
  const Verdict v = judge(reaction(seconds(1)), [](double) { return 1.0; });
  EXPECT_FALSE(v.pass);
  EXPECT_EQ(v.triggers, 0U);
  EXPECT_EQ(v.reason, "the trigger never came");
}

TEST(AfterJudge, OnlyWhatBecomesTrueInTheWindowIsATrigger) {
  Expectation e = reaction(seconds(1));
  e.from = at_s(3.0);
  e.to = at_s(6.0);
  const auto triggered = [&e](double begins_s, double ends_s) {
    const Signal trigger = [=](double t) { return t > begins_s - 1e-9 && t < ends_s ? 1.0 : 0.0; };
    return judge(
        e, [](double) { return 0.0; }, 10.0, trigger);
  };
  EXPECT_EQ(triggered(2.0, 2.5).triggers, 0U) << "before it";
  EXPECT_EQ(triggered(2.0, 9.0).triggers, 0U) << "a level that held before it";
  EXPECT_EQ(triggered(6.01, 9.0).triggers, 0U) << "after it";
  const Verdict last = triggered(6.0, 9.0);
  EXPECT_EQ(last.triggers, 1U);
  EXPECT_EQ(last.first_violation, at_s(7.0)) << "the answer may come after the window";
}

TEST(AfterJudge, AfterJudgesEveryRisingEdge) {
  const Signal square = [](double t) { return std::fmod(t, 2.0) > 1.0 - 1e-9 ? 1.0 : 0.0; };
  const Signal prompt = [&](double t) { return square(t - 0.3); };
  const Verdict good = judge(reaction(milliseconds(500)), prompt, 9.9, square);
  EXPECT_TRUE(good.pass) << good.reason;
  EXPECT_EQ(good.triggers, 5U);
  const Signal sleepy = [&](double t) { return t > 4.5 && t < 6.5 ? 0.0 : prompt(t); };
  const Verdict bad = judge(reaction(milliseconds(500)), sleepy, 9.9, square);
  EXPECT_FALSE(bad.pass);
  EXPECT_EQ(bad.first_violation, at_s(5.5));
}

TEST(AfterJudge, ALastTriggerWithoutTimeToAnswerCountsOnlyWhenItIsAlone) {
  const Signal late = [](double t) { return t > 9.5 ? 1.0 : 0.0; };
  const Signal never = [](double) { return 0.0; };
  EXPECT_FALSE(judge(reaction(seconds(1)), never, 10.0, late).pass);
  const Signal two = [&](double t) { return late(t) + (t > 1.0 && t < 2.0 ? 1.0 : 0.0); };
  const Signal early = [](double t) { return t < 3.0 ? 1.0 : 0.0; };
  EXPECT_TRUE(judge(reaction(seconds(1)), early, 10.0, two).pass);
}

TEST(AfterJudge, AfterAgreesWithItsDefinition) {
  // The oracle looks at the whole run at once.
  std::mt19937 engine{21};
  for (int round = 0; round < 300; ++round) {
    std::vector<double> x, y;
    for (int i = 0; i < 60; ++i) {
      x.push_back(engine() % 6 == 0 ? 1.0 : 0.0);
      y.push_back(engine() % 8 == 0 ? 1.0 : 0.0);
    }
    const int limit = 1 + static_cast<int>(engine() % 10);
    bool violated = false, decided = false;
    for (int i = 0; i < 60; ++i) {
      const auto k = static_cast<std::size_t>(i);
      if (y[k] < 0.5 || (i > 0 && y[k - 1] > 0.5)) continue;
      bool answered = false;
      for (int j = i; j <= std::min(i + limit, 59); ++j)
        answered = answered || x[static_cast<std::size_t>(j)] > 0.5;
      decided = decided || answered || i + limit < 59;
      violated = violated || (!answered && i + limit < 59);
    }
    const auto sample = [](const std::vector<double>& v) {
      return [&v](double t) { return v[static_cast<std::size_t>(std::lround(t * 100.0))]; };
    };
    const Verdict v = judge(reaction(milliseconds(10) * limit), sample(x), 0.59, sample(y));
    ASSERT_EQ(v.pass, decided && !violated) << "round " << round << ": " << v.reason;
  }
}

}  // namespace
}  // namespace pitwall::grading
