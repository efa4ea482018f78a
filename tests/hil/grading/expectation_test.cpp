// SPDX-License-Identifier: Apache-2.0
#include "hil/grading/expectation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "protocol/vocabulary/units.hpp"
#include "tests/hil/grading/infinity.hpp"
#include "tests/support/instants.hpp"

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
  for (const std::string_view kind : kind_names()) EXPECT_EQ(name_of(*kind_of(kind)), kind);
  EXPECT_EQ(name_of(Kind::kQuantile), "quantile") << "the last one";
  for (const std::string_view op : op_names()) EXPECT_EQ(name_of(*op_of(op)), op);
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
  e.release = {"gear", Op::kEqual, 0.0};
  e.kind = Kind::kUntil;
  EXPECT_EQ(to_string(e), "until gear == 0 within 5 s: speed_mps < 1, from 10 s");
  e.kind = Kind::kRate;
  EXPECT_EQ(to_string(e), "rate speed_mps < 1 per s, from 10 s");
  e.span = milliseconds(100);
  EXPECT_EQ(to_string(e), "rate speed_mps < 1 per s over 0.1 s, from 10 s");
  e.kind = Kind::kQuantile;
  e.share = 0.99;
  EXPECT_EQ(to_string(e), "quantile 0.99 of speed_mps < 1, from 10 s");
}

struct Shown {
  Kind kind;
  double limit_s, span_s;
  double bounded_s;              // the earliest end of a run that shows a window from 10 s to 15 s
  std::optional<double> open_s;  // likewise to the end of the run; absent: none does
};

TEST(Expectation, OfATimeThatIsCutAwayIsNotShown) {
  const Shown rows[] = {
      {Kind::kAlways, 0.0, 0.0, 10.01, 10.01}, {Kind::kNever, 0.0, 0.0, 10.01, 10.01},
      {Kind::kWithin, 0.0, 0.0, 15.0, 10.01},  {Kind::kDetects, 5.0, 0.0, 15.0, 10.01},
      {Kind::kAfter, 2.0, 0.0, 17.0, {}},      {Kind::kUntil, 3.0, 0.0, 13.0, 13.0},
      {Kind::kRate, 0.0, 0.5, 10.51, 10.51},   {Kind::kQuantile, 0.0, 0.0, 15.0, 10.01},
  };
  ASSERT_EQ(std::size(rows), kind_names().size());
  for (const Shown& row : rows) {
    Expectation e{.kind = row.kind,
                  .limit = from_seconds(row.limit_s),
                  .span = from_seconds(row.span_s),
                  .from = at_s(10.0)};
    for (double end_s = 9.0; end_s < 20.0; end_s += 0.01) {
      const bool open = row.open_s && end_s > *row.open_s - 0.005;
      ASSERT_EQ(is_shown_by(e, at_s(end_s)), open) << name_of(row.kind) << " " << end_s;
    }
    e.to = at_s(15.0);
    for (double end_s = 9.0; end_s < 20.0; end_s += 0.01)
      ASSERT_EQ(is_shown_by(e, at_s(end_s)), end_s > row.bounded_s - 0.005)
          << name_of(row.kind) << " " << end_s;
  }
}

}  // namespace
}  // namespace pitwall::grading
