// SPDX-License-Identifier: Apache-2.0
#include "hil/bench/contact.hpp"

#include <gtest/gtest.h>

#include "tests/support/instants.hpp"

namespace pitwall::bench {
namespace {

using grading::Expectation;
using grading::Kind;
using scenario::Scenario;

Expectation expectation(Kind kind, double from_s, std::optional<double> to_s = {}) {
  Expectation out{.kind = kind, .from = at_s(from_s)};
  if (to_s) out.to = at_s(*to_s);
  return out;
}

grading::Verdict verdict(const std::string& text, bool pass) {
  grading::Verdict out;
  out.name = "f.yaml:" + text;
  out.text = text;
  out.pass = pass;
  return out;
}

// A run that hit a wall after ten seconds at 40 m/s, or none.
struct Crash {
  Scenario scenario;
  RunResult result;

  explicit Crash(bool hit = true) {
    follow(result.outcome, {.at = at_s(9), .speed_mps = 41.0, .wall_gap_m = 3.0});
    if (hit)
      follow(
          result.outcome,
          {.at = at_s(10), .speed_mps = 40.0, .wall_gap_m = -0.1, .s_m = 700.0, .contact = true});
  }
  void expect(const Expectation& asked, const grading::Verdict& got) {
    scenario.expect.push_back(asked);
    result.verdicts.push_back(got);
  }
  bool passes() {
    judge_contact(scenario, result);
    return result.passed();
  }
};

TEST(Contact, NobodyNamedFailsTheRunWithPlaceAndSpeed) {
  Crash crash;
  EXPECT_FALSE(crash.passes());
  EXPECT_TRUE(crash.result.failed_by_contact());
  ASSERT_EQ(crash.result.verdicts.size(), 1U);
  EXPECT_EQ(crash.result.verdicts[0].reason,
            "CONTACT: the car hit the wall on the right at 10.00 s, s 700 m, at 40.0 m/s");
  EXPECT_EQ(crash.result.verdicts[0].first_violation, at_s(10));
  EXPECT_NE(to_text(crash.result).find("verdict: CONTACT\n"), std::string::npos);
  EXPECT_NE(to_json(crash.result).find("\"failed_by_contact\": true"), std::string::npos);
}

TEST(Contact, ANamedOnePassesUpToItsBound) {
  for (const double bound_mps : {39.9, 40.0, 60.0}) {
    Crash crash;
    crash.scenario.contact = {bound_mps, "nobody steers"};
    EXPECT_EQ(crash.passes(), bound_mps >= 40.0) << bound_mps;
    EXPECT_EQ(crash.result.failed_by_contact(), bound_mps < 40.0);
    EXPECT_DOUBLE_EQ(crash.result.verdicts.back().margin, bound_mps - 40.0);
  }
}

TEST(Contact, WithoutOneNothingIsAskedUnlessItIsNamed) {
  Crash none{false};
  EXPECT_TRUE(none.passes());
  EXPECT_TRUE(none.result.verdicts.empty());
  Crash named{false};
  named.scenario.contact = {30.0, "nobody steers"};
  EXPECT_TRUE(named.passes());
  EXPECT_EQ(named.result.verdicts.size(), 1U);
}

TEST(Contact, WhatWasNotShownByThenIsARemarkAndNoVerdict) {
  Crash crash;
  crash.scenario.contact = {60.0, "nobody steers"};
  crash.expect(expectation(Kind::kAlways, 0), verdict("always, begun", true));
  crash.expect(expectation(Kind::kNever, 12), verdict("never, later", false));
  crash.expect(expectation(Kind::kWithin, 5, 9), verdict("within, over", true));
  crash.expect(expectation(Kind::kWithin, 5, 20), verdict("within, met", true));
  crash.expect(expectation(Kind::kWithin, 5, 20), verdict("within, open", false));
  crash.expect(expectation(Kind::kDetects, 9.9, 10.4), verdict("detects, open", false));
  Expectation until = expectation(Kind::kUntil, 5);
  until.limit = seconds(10);
  crash.expect(until, verdict("until, released", true));
  crash.expect(until, verdict("until, open", false));
  crash.expect(expectation(Kind::kAfter, 0), verdict("after, open", true));
  crash.expect(expectation(Kind::kQuantile, 0, 20), verdict("quantile, open", false));
  EXPECT_TRUE(crash.passes());
  std::string shown;
  for (const grading::Verdict& one : crash.result.verdicts) shown += one.text + "; ";
  EXPECT_EQ(
      shown,
      "always, begun; within, over; within, met; until, released; no contact above 60.0 m/s; ");
  EXPECT_EQ(crash.result.remarks.size(), 6U);
  EXPECT_EQ(crash.result.remarks[0], "not judged, the car hit a wall before: never, later");
}

TEST(Contact, WhatFailedBeforeItStaysFailed) {
  Crash crash;
  crash.scenario.contact = {60.0, "nobody steers"};
  crash.expect(expectation(Kind::kDetects, 8, 9), verdict("detects, late", false));
  EXPECT_FALSE(crash.passes());
  EXPECT_FALSE(crash.result.failed_by_contact());
}

TEST(Contact, WhatFailedForGoodBeforeTheEndOfItsWindowStaysFailed) {
  for (const Kind kind : {Kind::kAfter, Kind::kUntil}) {
    Crash crash;
    crash.scenario.contact = {60.0, "nobody steers"};
    grading::Verdict failed = verdict("too late or broken", false);
    failed.first_violation = at_s(8);
    Expectation asked = expectation(kind, 5);
    asked.limit = seconds(20);
    crash.expect(asked, failed);
    EXPECT_FALSE(crash.passes()) << grading::name_of(kind);
  }
}

}  // namespace
}  // namespace pitwall::bench
