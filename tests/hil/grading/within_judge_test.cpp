// SPDX-License-Identifier: Apache-2.0
#include "hil/grading/within_judge.hpp"

#include <gtest/gtest.h>

#include "tests/hil/grading/judged.hpp"
#include "tests/support/instants.hpp"

namespace pitwall::grading {
namespace {

TEST(WithinJudge, WithinPassesUpToItsLimitAndKeepsTheTimeLeft) {
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

TEST(WithinJudge, WithinIsNotAcceptedWhenTheRunEndsTooEarly) {
  Expectation e = expect(Kind::kWithin, {"x", Op::kGreater, 1.0});
  e.limit = seconds(30);
  EXPECT_FALSE(judge(e, [](double) { return 0.0; }).pass);
}

}  // namespace
}  // namespace pitwall::grading
