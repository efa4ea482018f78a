// SPDX-License-Identifier: Apache-2.0
#include "hil/grading/quantile_judge.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "protocol/vocabulary/units.hpp"
#include "tests/hil/grading/infinity.hpp"
#include "tests/hil/grading/judged.hpp"
#include "tests/support/instants.hpp"

namespace pitwall::grading {
namespace {

Expectation quantile(double share, Op op, double number) {
  Expectation e = expect(Kind::kQuantile, {"x", op, number});
  e.share = share;
  return e;
}

// Of 1 to 1000, in an order of its own.
double shuffled(double t) {
  return std::fmod(std::round(t * 100.0) * 377.0, 1'000.0) + 1.0;  // 377 and 1000 are coprime
}

TEST(QuantileJudge, OfTheNumbersToAThousandIsTheirRank) {
  for (const double share : {0.001, 0.01, 0.5, 0.95, 0.99, 1.0}) {
    const Verdict below = judge(quantile(share, Op::kLessEqual, 1'000.0 * share), shuffled, 9.99);
    EXPECT_TRUE(below.pass) << share << ": " << below.reason;
    EXPECT_EQ(below.margin, 0.0) << share;
    EXPECT_EQ(below.ticks, 1'000U);
    EXPECT_FALSE(judge(quantile(share, Op::kLess, 1'000.0 * share), shuffled, 9.99).pass);
    EXPECT_TRUE(judge(quantile(share, Op::kGreaterEqual, 1'000.0 * share), shuffled, 9.99).pass);
    EXPECT_FALSE(judge(quantile(share, Op::kGreater, 1'000.0 * share), shuffled, 9.99).pass);
  }
}

TEST(QuantileJudge, AFewTicksBeyondTheLimitAreForgivenAndNamedIfTheyAreMore) {
  const auto peaks = [](int count) {
    return [count](double t) { return std::lround(t * 100.0) < count ? 0.9 : 0.1; };
  };
  EXPECT_TRUE(judge(quantile(0.99, Op::kLess, 0.3), peaks(10), 9.99).pass);
  const Verdict more = judge(quantile(0.99, Op::kLess, 0.3), peaks(11), 9.99);
  EXPECT_FALSE(more.pass);
  EXPECT_EQ(more.reason, "the quantile is 0.9");
  EXPECT_DOUBLE_EQ(more.margin, -0.6);
  EXPECT_FALSE(more.first_violation) << "it is a figure of the whole window";
}

TEST(QuantileJudge, ATickWithANaNDoesNotMeetTheCondition) {
  const auto holes = [](int count) {
    return [count](double t) { return std::lround(t * 100.0) < count ? kUnset : 0.5; };
  };
  for (const auto& [share, op, number] :
       {std::tuple{0.99, Op::kLess, 1.0}, std::tuple{0.01, Op::kGreater, 0.0}}) {
    EXPECT_TRUE(judge(quantile(share, op, number), holes(9), 9.99).pass);
    const Verdict more = judge(quantile(share, op, number), holes(11), 9.99);
    EXPECT_FALSE(more.pass);
    EXPECT_EQ(more.margin, -kInfinity);
    EXPECT_EQ(more.undefined, 11U);
  }
}

TEST(QuantileJudge, AWindowWithoutATickShowsNothing) {
  Expectation e = quantile(0.5, Op::kLess, 1.0);
  e.from = at_s(20.0);
  const Verdict v = judge(e, shuffled);
  EXPECT_EQ(v.reason, "no tick in its window");
  EXPECT_EQ(v.margin, -kInfinity);
}

}  // namespace
}  // namespace pitwall::grading
