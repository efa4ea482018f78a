// SPDX-License-Identifier: Apache-2.0
#include "hil/grading/grader.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "protocol/vocabulary/units.hpp"
#include "tests/hil/grading/infinity.hpp"
#include "tests/hil/grading/judged.hpp"
#include "tests/support/allocation_guard.hpp"
#include "tests/support/instants.hpp"

namespace pitwall::grading {
namespace {

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
  e = expect(Kind::kUntil, {"x", Op::kLess, 1.0});
  e.release = {"y", Op::kLess, 1.0};
  EXPECT_EQ(what(e), "needs a time limit above zero");
  e.limit = seconds(1);
  EXPECT_EQ(what(e), "");
  e.release.signal = "nowhere";
  EXPECT_EQ(what(e), "unknown signal \"nowhere\"");
  e = expect(Kind::kRate, {"x", Op::kLess, 1.0});
  e.span = milliseconds(-1);
  EXPECT_EQ(what(e), "its span is negative");
  e = expect(Kind::kQuantile, {"x", Op::kLess, 1.0});
  for (const double share : {kUnset, 0.0, 1.1}) {
    e.share = share;
    EXPECT_EQ(what(e), "needs a share above 0 and at most 1");
  }
  e.share = 1.0;
  EXPECT_EQ(what(e), "");
  e.condition.op = Op::kEqual;
  EXPECT_EQ(what(e), "needs one of: < <= > >=");
}

TEST(Grader, ObservingDoesNotAllocate) {
  Expectation until = expect(Kind::kUntil, {"x", Op::kLess, 1.0});
  until.release = {"y", Op::kGreater, 2.0};
  until.limit = seconds(9);
  Expectation rate = expect(Kind::kRate, {"x", Op::kLess, 1.0});
  rate.span = milliseconds(200);
  Expectation quantile = expect(Kind::kQuantile, {"x", Op::kLess, 1.0});
  quantile.share = 0.99;
  quantile.to = at_s(10.0);
  auto grader = Grader::create({reaction(seconds(1)), until, rate, quantile}, kNames);
  ASSERT_TRUE(grader);
  const double values[] = {0.0, 1.0};
  EXPECT_EQ(testing::allocations_of([&] {
              for (int i = 0; i < 1000; ++i)
                grader->observe(Instant{} + milliseconds(10) * i, values);
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

// Random expectations over random runs, with NaN and uneven ticks.
class RandomRuns {
 public:
  Expectation expectation(Kind kind) {
    Expectation e = expect(kind, condition("x"));
    if (kind == Kind::kQuantile) e.condition.op = static_cast<Op>(any_of(4));
    e.trigger = condition("y");
    e.release = condition("y");
    e.limit = milliseconds(10 + any_of(300));
    e.span = milliseconds(any_of(3) * 20);
    e.share = static_cast<double>(1 + any_of(100)) / 100.0;
    e.from = at_ms(any_of(200));
    if (kind == Kind::kDetects) e.from = at_ms(2'050 + any_of(100));
    if (any_of(3) == 0) e.to = *e.from + milliseconds(1 + any_of(300));
    return e;
  }

  // One value of x and y per tick; a run has up to 60.
  std::vector<Tick> run(Kind kind) {
    std::vector<Tick> ticks;
    Instant at = at_ms(kind == Kind::kDetects ? 2'000 : 0);
    for (std::int64_t i = any_of(60); i > 0; --i, at += milliseconds(1 + any_of(20)))
      ticks.push_back({.at = at, .value = level(), .other = level()});
    return ticks;
  }

 private:
  std::int64_t any_of(std::int64_t count) { return static_cast<std::int64_t>(engine_()) % count; }
  double level() { return any_of(40) == 0 ? kUnset : static_cast<double>(any_of(9)) * 0.25 - 1.0; }
  Condition condition(const char* signal) {
    return {signal, static_cast<Op>(any_of(6)), static_cast<double>(any_of(9)) * 0.25 - 1.0};
  }

  std::mt19937 engine_{11};
};

bool is_in_window(const Expectation& e, Instant at) {
  return at >= *e.from && (!e.to || at <= *e.to);
}

struct Judged {
  Verdict verdict;
  bool is_failure_final = true;
};

Judged judged(const Expectation& e, const std::vector<Tick>& run) {
  Grader grader = grader_of(e);
  Judged out;
  bool has_failed = false;
  for (const Tick& tick : run) {
    const double values[] = {tick.value, tick.other};
    grader.observe(tick.at, values);
    const bool failed = grader.expectation_states()[0] == ExpectationState::kFailed;
    out.is_failure_final = out.is_failure_final && (failed || !has_failed);
    has_failed = has_failed || failed;
  }
  out.verdict = grader.finish().at(0);
  out.is_failure_final = out.is_failure_final && !(has_failed && out.verdict.pass);
  EXPECT_EQ(out.verdict.pass, grader.expectation_states()[0] == ExpectationState::kHolds);
  return out;
}

constexpr Kind kAllKinds[] = {Kind::kAlways,  Kind::kNever, Kind::kWithin, Kind::kAfter,
                              Kind::kDetects, Kind::kUntil, Kind::kRate,   Kind::kQuantile};

TEST(Grader, TheSignOfTheMarginIsTheVerdictForEveryKind) {
  RandomRuns random;
  for (const Kind kind : kAllKinds) {
    std::size_t passed = 0, failed = 0;
    for (int round = 0; round < 2'000; ++round) {
      const Expectation e = random.expectation(kind);
      const auto [verdict, is_failure_final] = judged(e, random.run(kind));
      ASSERT_TRUE(is_failure_final) << to_string(e);
      // What the run was too short for, or what held before its fault, says nothing by its margin.
      const bool is_told =
          verdict.reason != "it held before the fault began" && verdict.margin != kInfinity;
      if (is_told && verdict.margin > 0.0) {
        ASSERT_TRUE(verdict.pass) << to_string(e) << ": " << verdict.reason;
      }
      if (is_told && verdict.margin < 0.0) {
        ASSERT_FALSE(verdict.pass) << to_string(e);
      }
      (verdict.pass ? passed : failed) += 1;
    }
    EXPECT_GT(passed, 50U) << name_of(kind);
    EXPECT_GT(failed, 50U) << name_of(kind);
  }
}

// Margin and verdict of the whole run at once, as the kinds are defined.
struct Defined {
  double margin;
  bool pass;
};

Defined invariance(const Expectation& e, const std::vector<Tick>& ticks) {
  const bool wanted = e.kind == Kind::kAlways;
  Defined out{kInfinity, !ticks.empty()};
  for (const Tick& tick : ticks) {
    const double m = margin(e.condition, tick.value);
    const bool undefined = std::isnan(tick.value);
    out.margin = std::min(out.margin, undefined || wanted ? m : -m);
    out.pass = out.pass && !undefined && holds(e.condition, tick.value) == wanted;
  }
  return out;
}

Defined existence(const Expectation& e, const std::vector<Tick>& ticks) {
  Defined out{-kInfinity, false};
  for (const Tick& tick : ticks) {
    if (tick.at > *e.from + e.limit) continue;
    out.margin = std::max(out.margin, margin(e.condition, tick.value));
    out.pass = out.pass || holds(e.condition, tick.value);
  }
  return out;
}

Defined strong_until(const Expectation& e, const std::vector<Tick>& ticks) {
  Defined out{-kInfinity, false};
  for (std::size_t k = 0; k < ticks.size(); ++k) {
    if (ticks[k].at > *e.from + e.limit) continue;
    double robustness = margin(e.release, ticks[k].other);
    bool holds_here = holds(e.release, ticks[k].other);
    for (std::size_t j = 0; j < k; ++j) {
      robustness = std::min(robustness, margin(e.condition, ticks[j].value));
      holds_here = holds_here && holds(e.condition, ticks[j].value);
    }
    out.margin = std::max(out.margin, robustness);
    out.pass = out.pass || holds_here;
  }
  return out;
}

Defined bounded_rate(const Expectation& e, const std::vector<Tick>& ticks) {
  Defined out{kInfinity, true};
  std::size_t compared = 0;
  for (std::size_t k = 0; k < ticks.size(); ++k) {
    const auto earlier =
        std::find_if(ticks.rend() - static_cast<std::ptrdiff_t>(k), ticks.rend(),
                     [&](const Tick& tick) { return ticks[k].at - tick.at >= e.span; });
    if (earlier == ticks.rend() && !std::isnan(ticks[k].value)) continue;
    ++compared;
    const double rate = earlier == ticks.rend() ? kUnset
                                                : std::abs(ticks[k].value - earlier->value) /
                                                      (ticks[k].at - earlier->at).seconds();
    out.margin = std::min(out.margin, margin(e.condition, rate));
    out.pass = out.pass && holds(e.condition, rate);
  }
  out.pass = out.pass && compared > 0;
  return out;
}

// The least value that at least this share of the values is not above.
Defined share_quantile(const Expectation& e, const std::vector<Tick>& ticks) {
  const bool upper = e.condition.op == Op::kLess || e.condition.op == Op::kLessEqual;
  std::vector<double> values;
  for (const Tick& tick : ticks)
    values.push_back(!std::isnan(tick.value) ? tick.value : upper ? kInfinity : -kInfinity);
  std::ranges::sort(values);
  for (const double value : values) {
    const auto not_above = std::ranges::count_if(values, [&](double v) { return v <= value; });
    if (static_cast<double>(not_above) >= e.share * static_cast<double>(values.size()))
      return {margin(e.condition, value), holds(e.condition, value)};
  }
  return {-kInfinity, false};
}

Defined by_definition(const Expectation& e, std::vector<Tick> ticks) {
  std::erase_if(ticks, [&e](const Tick& tick) { return !is_in_window(e, tick.at); });
  switch (e.kind) {
    case Kind::kAlways:
    case Kind::kNever:
      return invariance(e, ticks);
    case Kind::kUntil:
      return strong_until(e, ticks);
    case Kind::kRate:
      return bounded_rate(e, ticks);
    case Kind::kQuantile:
      return share_quantile(e, ticks);
    default:
      return existence(e, ticks);
  }
}

TEST(Grader, VerdictAndMarginAreThoseOfTheDefinition) {
  RandomRuns random;
  for (const Kind kind : kAllKinds) {
    if (kind == Kind::kAfter || kind == Kind::kDetects) continue;  // with their own tests
    for (int round = 0; round < 2'000; ++round) {
      const Expectation e = random.expectation(kind);
      const std::vector<Tick> run = random.run(kind);
      const Verdict verdict = judged(e, run).verdict;
      const Defined defined = by_definition(e, run);
      ASSERT_EQ(verdict.margin, defined.margin) << to_string(e);
      ASSERT_EQ(verdict.pass, defined.pass) << to_string(e) << ": " << verdict.reason;
    }
  }
}

}  // namespace
}  // namespace pitwall::grading
