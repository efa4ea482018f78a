// SPDX-License-Identifier: Apache-2.0
#include "hil/grading/until_judge.hpp"

#include <gtest/gtest.h>

#include "protocol/vocabulary/units.hpp"
#include "tests/hil/grading/judged.hpp"
#include "tests/support/instants.hpp"

namespace pitwall::grading {
namespace {

// x < 1 until y > 0.5, from 2 s on, at most 3 s later.
Expectation release_by_five() {
  Expectation e = expect(Kind::kUntil, {"x", Op::kLess, 1.0});
  e.release = {"y", Op::kGreater, 0.5};
  e.from = at_s(2.0);
  e.limit = seconds(3);
  return e;
}

Signal from(double begins_s, double value = 2.0) {
  return [=](double t) { return t > begins_s - 1e-9 ? value : 0.0; };
}

TEST(UntilJudge, TheConditionIsFreeFromItsReleaseOn) {
  for (const double released_s : {2.0, 3.0, 5.0, 5.01}) {
    const Verdict v = judge(release_by_five(), from(released_s), 10.0, from(released_s));
    EXPECT_EQ(v.pass, released_s <= 5.0) << released_s << ": " << v.reason;
    if (v.pass) {
      EXPECT_EQ(v.time_left, from_seconds(5.0 - released_s));
    }
  }
}

TEST(UntilJudge, TheReleaseCountsFromTheStartOfTheWindow) {
  EXPECT_TRUE(judge(release_by_five(), from(2.0), 10.0, from(1.0)).pass);
  const Signal early = [](double t) { return t < 1.5 ? 1.0 : 0.0; };
  EXPECT_FALSE(judge(release_by_five(), from(9.0), 10.0, early).pass);
}

TEST(UntilJudge, SaysWhatWentWrongAndWhen) {
  const Verdict broken = judge(release_by_five(), from(3.0), 10.0, from(4.0));
  EXPECT_EQ(broken.reason, "violated at 3.000 s, before its release");
  EXPECT_EQ(broken.first_violation, at_s(3.0));
  EXPECT_EQ(broken.margin, -0.5) << "the least that y lacked while x was still below 1";
  const Verdict late = judge(release_by_five(), from(11.0), 10.0, from(11.0));
  EXPECT_EQ(late.reason, "was not released by 5.000 s");
  EXPECT_EQ(late.first_violation, at_s(5.0));
  EXPECT_EQ(late.margin, -0.5) << "y is 0 for 0.5";
  const Verdict cut = judge(release_by_five(), from(11.0), 4.0, from(11.0));
  EXPECT_EQ(cut.reason, "the run ended before its release");
  EXPECT_FALSE(cut.first_violation);
  EXPECT_EQ(judge(release_by_five(), from(11.0), 1.0, from(11.0)).reason, "no tick in its window");
}

TEST(UntilJudge, ANaNBeforeTheReleaseFailsAndLaterDoesNot) {
  const auto hole_at = [](double t_s) {
    return [=](double t) { return t > t_s - 1e-9 && t < t_s + 0.005 ? kUnset : 0.0; };
  };
  EXPECT_FALSE(judge(release_by_five(), hole_at(2.5), 10.0, from(3.0)).pass);
  EXPECT_TRUE(judge(release_by_five(), hole_at(3.5), 10.0, from(3.0)).pass);
  const Signal lost = [](double) { return kUnset; };
  EXPECT_FALSE(judge(release_by_five(), from(11.0), 10.0, lost).pass);
}

}  // namespace
}  // namespace pitwall::grading
