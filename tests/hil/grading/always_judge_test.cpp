// SPDX-License-Identifier: Apache-2.0
#include "hil/grading/always_judge.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/hil/grading/infinity.hpp"
#include "tests/hil/grading/judged.hpp"
#include "tests/support/instants.hpp"

namespace pitwall::grading {
namespace {

TEST(AlwaysJudge, AlwaysHasTheLeastMarginOfTheRun) {
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

TEST(AlwaysJudge, NeverIsAlwaysOfTheNegation) {
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

TEST(AlwaysJudge, AnUndefinedValueSatisfiesNeitherAlwaysNorNever) {
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

}  // namespace
}  // namespace pitwall::grading
