// SPDX-License-Identifier: Apache-2.0
#include "hil/grading/grader.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "protocol/vocabulary/units.hpp"
#include "tests/hil/grading/infinity.hpp"
#include "tests/support/allocation_guard.hpp"
#include "tests/support/instants.hpp"

namespace pitwall::grading {
namespace {

const std::vector<std::string> kNames{"x", "y"};

Expectation expect(Kind kind, Condition condition) {
  Expectation e;
  e.kind = kind;
  e.condition = std::move(condition);
  return e;
}

Grader grader_of(const Expectation& e) {
  auto grader = Grader::create({e}, kNames);
  EXPECT_TRUE(grader.has_value());
  return *std::move(grader);
}

using Signal = std::function<double(double)>;

// 100 Hz for `time_s` seconds.
Verdict judge(
    const Expectation& e, const Signal& x, double time_s = 10.0,
    const Signal& y = [](double) { return 0.0; }) {
  Grader grader = grader_of(e);
  for (int i = 0; i * 0.01 <= time_s + 1e-9; ++i) {
    const double values[] = {x(i * 0.01), y(i * 0.01)};
    grader.observe(Instant{} + milliseconds(10) * i, values);
  }
  return grader.finish().at(0);
}

Expectation detection(Duration limit) {
  Expectation e = expect(Kind::kDetects, {"x", Op::kEqual, 1.0});
  e.from = at_s(5.0);
  e.to = at_s(5.0) + limit;
  e.limit = limit;
  return e;
}

TEST(Grader, ADetectionIsMeasuredFromItsFault) {
  for (const double delay_s : {0.01, 0.02, 0.05, 0.1}) {
    const Verdict v = judge(detection(milliseconds(100)),
                            [delay_s](double t) { return t >= 5.0 + delay_s - 1e-6 ? 1.0 : 0.0; });
    EXPECT_TRUE(v.pass) << v.reason;
    ASSERT_TRUE(v.delay);
    EXPECT_NEAR(v.delay->seconds(), delay_s, 1e-9);
  }
  const Verdict late =
      judge(detection(milliseconds(100)), [](double t) { return t >= 5.109 ? 1.0 : 0.0; });
  EXPECT_FALSE(late.pass);
  EXPECT_FALSE(late.delay);
}

TEST(Grader, WhatWasSeenBeforeAFaultIsNoDetection) {
  const auto seen_at = [](double from_s, double to_s) {
    return judge(detection(milliseconds(100)),
                 [=](double t) { return (t > from_s && t < to_s) || t > 5.02 ? 1.0 : 0.0; });
  };
  EXPECT_FALSE(seen_at(4.995, 5.005).pass) << "the tick of the fault itself comes before it";
  EXPECT_FALSE(seen_at(3.5, 3.6).pass);
  EXPECT_TRUE(seen_at(2.5, 2.6).pass) << "longer ago than kQuiet";
}

TEST(Grader, ADetectionNeedsItsFault) {
  Expectation e = detection(milliseconds(100));
  e.from.reset();
  EXPECT_FALSE(Grader::create({e}, kNames).has_value());
}

TEST(Grader, AlwaysHasTheLeastMarginOfTheRun) {
  const Signal wave = [](double t) { return std::sin(t); };
  const Verdict pass = judge(expect(Kind::kAlways, {"x", Op::kLess, 1.5}), wave);
  EXPECT_TRUE(pass.pass) << pass.reason;
  EXPECT_NEAR(pass.margin, 0.5, 1e-4);
  EXPECT_FALSE(pass.first_violation.has_value());
  const Verdict fail = judge(expect(Kind::kAlways, {"x", Op::kLess, 0.5}), wave);
  EXPECT_FALSE(fail.pass);
  EXPECT_NEAR(fail.margin, -0.5, 1e-4);
  EXPECT_EQ(fail.first_violation, at_s(0.53));  // asin(0.5) = 0.5236
}

TEST(Grader, NeverIsAlwaysOfTheNegation) {
  std::mt19937 engine{5};
  for (int round = 0; round < 50; ++round) {
    const double a = static_cast<double>(engine() % 100) / 50.0;
    const double limit = static_cast<double>(engine() % 200) / 100.0;
    const Signal x = [a](double t) { return a * std::sin(t); };
    const Verdict never = judge(expect(Kind::kNever, {"x", Op::kGreater, limit}), x);
    const Verdict always = judge(expect(Kind::kAlways, {"x", Op::kLessEqual, limit}), x);
    EXPECT_EQ(never.pass, always.pass);
    EXPECT_EQ(never.margin, always.margin);
    EXPECT_EQ(never.first_violation, always.first_violation);
  }
}

TEST(Grader, AnUndefinedValueSatisfiesNeitherAlwaysNorNever) {
  const Signal hole = [](double t) { return t > 3.0 && t < 3.1 ? kUnset : 0.0; };
  for (const Kind kind : {Kind::kAlways, Kind::kNever}) {
    const double limit = kind == Kind::kAlways ? 1.0 : -1.0;
    const Verdict v = judge(expect(kind, {"x", Op::kLess, limit}), hole);
    EXPECT_FALSE(v.pass);
    EXPECT_EQ(v.margin, -kInfinity);
    EXPECT_EQ(v.undefined, 9U);
    EXPECT_EQ(v.first_violation, at_s(3.01));
  }
}

TEST(Grader, OnlyTheWindowCounts) {
  const Signal ramp = [](double t) { return t; };
  Expectation e = expect(Kind::kAlways, {"x", Op::kLessEqual, 5.0});
  EXPECT_FALSE(judge(e, ramp).pass);
  e.to = at_s(5.0);
  EXPECT_TRUE(judge(e, ramp).pass);
  e.condition = {"x", Op::kGreaterEqual, 2.0};
  e.from = at_s(2.0);
  const Verdict v = judge(e, ramp);
  EXPECT_TRUE(v.pass);
  EXPECT_EQ(v.ticks, 301U);
}

TEST(Grader, AWindowThatTheRunNeverReachesFails) {
  for (const Kind kind : {Kind::kAlways, Kind::kNever, Kind::kWithin}) {
    Expectation e = expect(kind, {"x", Op::kLess, 1.0});
    e.from = at_s(20.0);
    e.limit = seconds(1);
    const Verdict v = judge(e, [](double) { return 0.0; });
    EXPECT_FALSE(v.pass);
    EXPECT_EQ(v.ticks, 0U);
    EXPECT_FALSE(v.reason.empty());
  }
}

TEST(Grader, WithinPassesUpToItsLimitAndKeepsTheTimeLeft) {
  for (const double reached_s : {1.0, 3.99, 4.0, 4.01, 6.0}) {
    Expectation e = expect(Kind::kWithin, {"x", Op::kGreaterEqual, 1.0});
    e.limit = seconds(3);
    e.from = at_s(1.0);
    const Verdict v = judge(e, [&](double t) { return t > reached_s - 1e-9 ? 2.0 : 0.0; });
    const bool in_time = reached_s <= 4.0;
    EXPECT_EQ(v.pass, in_time) << reached_s;
    EXPECT_DOUBLE_EQ(v.margin, in_time ? 1.0 : -1.0);
    if (in_time) {
      EXPECT_EQ(v.time_left, from_seconds(4.0 - reached_s));
    } else {
      EXPECT_EQ(v.first_violation, at_s(4.0));
    }
  }
}

TEST(Grader, WithinIsNotAcceptedWhenTheRunEndsTooEarly) {
  Expectation e = expect(Kind::kWithin, {"x", Op::kGreater, 1.0});
  e.limit = seconds(30);
  EXPECT_FALSE(judge(e, [](double) { return 0.0; }).pass);
}

Expectation reaction(Duration limit) {
  Expectation e = expect(Kind::kAfter, {"x", Op::kGreater, 0.5});
  e.trigger = {"y", Op::kGreater, 0.5};
  e.limit = limit;
  return e;
}

TEST(Grader, AfterWaitsForTheTriggerAndAllowsTheLimit) {
  const Signal trigger = [](double t) { return t > 2.0 - 1e-9 && t < 2.5 ? 1.0 : 0.0; };
  for (const double answer_s : {2.0, 2.3, 3.0, 3.01}) {
    const Verdict v = judge(
        reaction(seconds(1)), [&](double t) { return t > answer_s - 1e-9 ? 1.0 : 0.0; }, 10.0,
        trigger);
    EXPECT_EQ(v.pass, answer_s <= 3.0) << answer_s;
    EXPECT_EQ(v.triggers, 1U);
  }
}

TEST(Grader, AfterFailsWhenTheTriggerNeverComes) {
  const Verdict v = judge(reaction(seconds(1)), [](double) { return 1.0; });
  EXPECT_FALSE(v.pass);
  EXPECT_EQ(v.triggers, 0U);
  EXPECT_EQ(v.reason, "the trigger never came");
}

TEST(Grader, AfterJudgesEveryRisingEdge) {
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

TEST(Grader, ALastTriggerWithoutTimeToAnswerCountsOnlyWhenItIsAlone) {
  const Signal late = [](double t) { return t > 9.5 ? 1.0 : 0.0; };
  const Signal never = [](double) { return 0.0; };
  EXPECT_FALSE(judge(reaction(seconds(1)), never, 10.0, late).pass);
  const Signal two = [&](double t) { return late(t) + (t > 1.0 && t < 2.0 ? 1.0 : 0.0); };
  const Signal early = [](double t) { return t < 3.0 ? 1.0 : 0.0; };
  EXPECT_TRUE(judge(reaction(seconds(1)), early, 10.0, two).pass);
}

TEST(Grader, AfterAgreesWithItsDefinition) {
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

TEST(Grader, RefusesWhatCannotBeJudged) {
  const auto what = [](const Expectation& e) {
    const auto grader = Grader::create({expect(Kind::kAlways, {"x", Op::kLess, 1.0}), e}, kNames);
    if (grader) return std::string();
    EXPECT_EQ(grader.error().place, "expect[1]");
    return grader.error().what;
  };
  EXPECT_EQ(what(expect(Kind::kAlways, {"z", Op::kLess, 1.0})), "unknown signal \"z\"");
  EXPECT_NE(what(expect(Kind::kAlways, {"x", Op::kLess, kUnset})), "");
  EXPECT_NE(what(expect(Kind::kWithin, {"x", Op::kLess, 1.0})), "");
  Expectation e = reaction(seconds(1));
  EXPECT_EQ(what(e), "");
  e.trigger.signal = "nowhere";
  EXPECT_EQ(what(e), "unknown signal \"nowhere\"");
  e = expect(Kind::kAlways, {"x", Op::kLess, 1.0});
  e.from = at_s(2.0);
  e.to = at_s(1.0);
  EXPECT_NE(what(e), "");
}

TEST(Grader, ObservingDoesNotAllocate) {
  Grader grader = grader_of(reaction(seconds(1)));
  const double values[] = {0.0, 1.0};
  EXPECT_EQ(testing::allocations_of([&] {
              for (int i = 0; i < 1000; ++i)
                grader.observe(Instant{} + milliseconds(10) * i, values);
            }),
            0U);
}

TEST(Grader, AStandingIsOpenUntilSomethingWasSeenAndFailsForGood) {
  Expectation late = expect(Kind::kAlways, {"x", Op::kLess, 1.0});
  late.from = at_s(0.5);
  Expectation within = expect(Kind::kWithin, {"x", Op::kGreater, 5.0});
  within.limit = seconds(1);
  const Expectation never = expect(Kind::kNever, {"x", Op::kGreater, 8.0});
  auto grader = Grader::create({late, within, never}, kNames);
  ASSERT_TRUE(grader);
  using enum ExpectationState;
  const auto after = [&](double t_s, double x) {
    const double values[] = {x, 0.0};
    grader->observe(at_s(t_s), values);
    return grader->expectation_states();
  };
  EXPECT_EQ(grader->expectation_states(), (std::vector{kOpen, kOpen, kOpen}));
  EXPECT_EQ(after(0.1, 0.0), (std::vector{kOpen, kOpen, kHolds}));
  EXPECT_EQ(after(0.6, 0.0), (std::vector{kHolds, kOpen, kHolds}));
  EXPECT_EQ(after(0.7, 6.0), (std::vector{kFailed, kHolds, kHolds}));
  EXPECT_EQ(after(0.8, 9.0), (std::vector{kFailed, kHolds, kFailed}));
  EXPECT_EQ(after(5.0, 0.0), (std::vector{kFailed, kHolds, kFailed}));
  for (std::size_t i = 0; const Verdict& verdict : grader->finish())
    EXPECT_EQ(verdict.pass, grader->expectation_states()[i++] == kHolds);
}

}  // namespace
}  // namespace pitwall::grading
