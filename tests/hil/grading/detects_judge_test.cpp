// SPDX-License-Identifier: Apache-2.0
#include "hil/grading/detects_judge.hpp"

#include <gtest/gtest.h>

#include "tests/hil/grading/judged.hpp"

namespace pitwall::grading {
namespace {

TEST(DetectsJudge, ADetectionIsMeasuredFromItsFault) {
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

TEST(DetectsJudge, WhatWasSeenBeforeAFaultIsNoDetection) {
  const auto seen_at = [](double from_s, double to_s) {
    return judge(detection(milliseconds(100)),
                 [=](double t) { return (t > from_s && t < to_s) || t > 5.02 ? 1.0 : 0.0; });
  };
  EXPECT_FALSE(seen_at(4.995, 5.005).pass) << "the tick of the fault itself comes before it";
  EXPECT_FALSE(seen_at(3.5, 3.6).pass);
  EXPECT_TRUE(seen_at(2.5, 2.6).pass) << "longer ago than kQuiet";
}

TEST(DetectsJudge, ADetectionNeedsItsFault) {
  Expectation e = detection(milliseconds(100));
  e.from.reset();
  EXPECT_FALSE(Grader::create({e}, kNames).has_value());
}

}  // namespace
}  // namespace pitwall::grading
