// SPDX-License-Identifier: Apache-2.0
#include "hil/grading/rate_judge.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "protocol/vocabulary/units.hpp"
#include "tests/hil/grading/infinity.hpp"
#include "tests/hil/grading/judged.hpp"
#include "tests/support/instants.hpp"

namespace pitwall::grading {
namespace {

Expectation rate_below(double limit, Duration span = {}) {
  Expectation e = expect(Kind::kRate, {"x", Op::kLess, limit});
  e.span = span;
  return e;
}

TEST(RateJudge, ARampHasItsSlopeInEitherDirectionOverAnySpan) {
  for (const double slope : {-3.0, 0.0, 2.0})
    for (const Duration span : {Duration{}, milliseconds(10), milliseconds(95), seconds(2)}) {
      const Verdict v = judge(rate_below(5.0, span), [slope](double t) { return slope * t; });
      EXPECT_TRUE(v.pass) << v.reason;
      EXPECT_NEAR(v.margin, 5.0 - std::abs(slope), 1e-9);
    }
}

TEST(RateJudge, ALongerSpanForgivesAShortStep) {
  const Signal step = [](double t) { return t > 5.0 - 1e-9 ? 1.0 : 0.0; };
  const Verdict at_once = judge(rate_below(20.0), step);
  EXPECT_FALSE(at_once.pass);
  EXPECT_NEAR(at_once.margin, 20.0 - 100.0, 1e-6) << "1 in 10 ms";
  EXPECT_EQ(at_once.first_violation, at_s(5.0));
  const Verdict over = judge(rate_below(20.0, milliseconds(100)), step);
  EXPECT_TRUE(over.pass) << over.reason;
  EXPECT_NEAR(over.margin, 20.0 - 10.0, 1e-6) << "1 in 100 ms";
}

TEST(RateJudge, ANaNFailsWhereverItIs) {
  for (const double hole_s : {0.0, 0.05, 5.0, 10.0}) {
    const Signal x = [=](double t) { return std::abs(t - hole_s) < 1e-6 ? kUnset : 1.0; };
    const Verdict v = judge(rate_below(1.0, milliseconds(100)), x);
    EXPECT_FALSE(v.pass) << hole_s;
    EXPECT_EQ(v.margin, -kInfinity);
    EXPECT_EQ(v.first_violation, at_s(hole_s));
    EXPECT_EQ(v.undefined, 1U);
  }
}

TEST(RateJudge, WhatWasBeforeTheWindowIsNotCompared) {
  Expectation e = rate_below(1.0);
  e.from = at_s(5.0);
  EXPECT_TRUE(judge(e, [](double t) { return t > 5.0 - 1e-9 ? 8.0 : kUnset; }).pass);
}

TEST(RateJudge, AWindowShorterThanTheSpanShowsNothing) {
  Expectation e = rate_below(1.0, seconds(1));
  e.to = at_s(0.9);
  const Verdict v = judge(e, [](double) { return 0.0; });
  EXPECT_EQ(v.reason, "no two ticks in its window to compare");
  EXPECT_EQ(v.ticks, 0U);
}

// A tick every 0.1 ms for a second: what is kept is bounded, and a sine keeps its steepest slope.
TEST(RateJudge, TicksThatComeMoreOftenThanExpectedAreStillCompared) {
  Grader grader = grader_of(rate_below(100.0, milliseconds(20)));
  for (int i = 0; i < 10'000; ++i) {
    const double t = i * 1e-4;
    const double values[] = {std::sin(2.0 * std::numbers::pi * t), 0.0};
    grader.observe(Instant{} + microseconds(100) * i, values);
  }
  const Verdict v = grader.finish()[0];
  EXPECT_EQ(v.ticks, 10'000U - 200U);
  EXPECT_NEAR(v.margin, 100.0 - 2.0 * std::numbers::pi, 0.05);
}

}  // namespace
}  // namespace pitwall::grading
