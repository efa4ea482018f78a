// SPDX-License-Identifier: Apache-2.0
#include "hil/grading/expectation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "protocol/vocabulary/units.hpp"
#include "tests/hil/grading/infinity.hpp"

namespace pitwall::grading {
namespace {

constexpr Op kAllOps[] = {Op::kLess,         Op::kLessEqual, Op::kGreater,
                          Op::kGreaterEqual, Op::kEqual,     Op::kNotEqual};

TEST(Condition, TheSignOfTheMarginAgreesWithTheTruth) {
  const double values[] = {-kInfinity, -1e300, -2.0, -1.0,  -1e-12,   0.0,
                           1e-12,      1.0,    2.0,  1e300, kInfinity};
  for (const Op op : kAllOps)
    for (const double x : values)
      for (const double c : {-1.0, 0.0, 1.0, 2.0}) {
        const double m = margin(op, x, c, 0.0);
        if (m > 0.0) {
          EXPECT_TRUE(holds(op, x, c, 0.0)) << name_of(op) << x << " " << c;
        }
        if (m < 0.0) {
          EXPECT_FALSE(holds(op, x, c, 0.0)) << name_of(op) << x << " " << c;
        }
        EXPECT_FALSE(std::isnan(m));
      }
}

TEST(Condition, TheMarginIsTheDistanceToTheLimit) {
  EXPECT_DOUBLE_EQ(margin(Op::kLess, 1.5, 2.0, 0.0), 0.5);
  EXPECT_DOUBLE_EQ(margin(Op::kGreater, 1.5, 2.0, 0.0), -0.5);
  EXPECT_DOUBLE_EQ(margin(Op::kEqual, 1.5, 2.0, 1.0), 0.5);
  EXPECT_DOUBLE_EQ(margin(Op::kNotEqual, 1.5, 2.0, 0.25), 0.25);
}

TEST(Condition, NoNumberMeetsNoCondition) {
  for (const Op op : kAllOps) {
    EXPECT_EQ(margin(op, kUnset, 1.0, 0.0), -kInfinity) << name_of(op);
    EXPECT_FALSE(holds(op, kUnset, 1.0, 0.0)) << name_of(op);
  }
}

TEST(Condition, NegatedOperatorsAreNegations) {
  const Op pairs[][2] = {
      {Op::kLess, Op::kGreaterEqual}, {Op::kGreater, Op::kLessEqual}, {Op::kEqual, Op::kNotEqual}};
  for (const auto& [op, negation] : pairs)
    for (const double x : {-1.0, 0.0, 1.0, 1.05, 1.2}) {
      EXPECT_NE(holds(op, x, 1.0, 0.1), holds(negation, x, 1.0, 0.1));
      EXPECT_EQ(margin(op, x, 1.0, 0.1), -margin(negation, x, 1.0, 0.1));
    }
}

TEST(Expectation, NamesReadBack) {
  for (const Op op : kAllOps) EXPECT_EQ(op_of(name_of(op)), op);
  for (const Kind k : {Kind::kAlways, Kind::kNever, Kind::kWithin, Kind::kAfter})
    EXPECT_EQ(kind_of(name_of(k)), k);
  EXPECT_FALSE(op_of("=<").has_value());
  EXPECT_FALSE(kind_of("often").has_value());
}

TEST(Expectation, ReadsAsASentence) {
  Expectation e{.name = {},
                .kind = Kind::kAfter,
                .condition = {"speed_mps", Op::kLess, 1.0},
                .trigger = {"brake_kpa", Op::kGreater, 100.0},
                .limit = seconds(5),
                .from = Instant{} + seconds(10),
                .to = {}};
  EXPECT_EQ(to_string(e), "after brake_kpa > 100: speed_mps < 1 within 5 s, from 10 s");
  e.kind = Kind::kWithin;
  EXPECT_EQ(to_string(e), "within 5 s speed_mps < 1, from 10 s");
}

}  // namespace
}  // namespace pitwall::grading
