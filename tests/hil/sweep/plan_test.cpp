// SPDX-License-Identifier: Apache-2.0
#include "hil/sweep/plan.hpp"

#include <gtest/gtest.h>

#include <string>

#include "tests/hil/sweep/plan_text.hpp"

namespace pitwall::sweep {
namespace {

std::string refusal(const std::string& text) {
  const auto plan = read_plan(text, "p.yaml");
  EXPECT_FALSE(plan) << text;
  return plan ? "" : to_string(plan.error());
}

TEST(SweepPlan, HasWhatTheFileSays) {
  const auto plan = read_plan(drawn_plan(), "p.yaml");
  ASSERT_TRUE(plan) << to_string(plan.error());
  EXPECT_EQ(plan->name, "some");
  EXPECT_EQ(plan->scenario_file, "hil/scenarios/grip_low.yaml");
  EXPECT_EQ(plan->combine, Combine::kDraw);
  EXPECT_EQ(plan->cases, 40U);
  ASSERT_EQ(plan->parameters.size(), 2U);
  EXPECT_EQ(plan->parameters[0].from, 0.5);
  EXPECT_EQ(plan->parameters[0].to, 1.5);
  EXPECT_EQ(plan->parameters[1].values, (std::vector<std::string>{"0", "8"}));
}

TEST(SweepPlan, WhatIsWrongIsToldWithItsPlace) {
  EXPECT_NE(refusal(spoilt(drawn_plan(), "combine: draw", "combine: any")).find("p.yaml:5"),
            std::string::npos);
  EXPECT_NE(refusal(spoilt(drawn_plan(), "cases: 40", "cases: 0")).find("cases"),
            std::string::npos);
  EXPECT_NE(refusal(spoilt(drawn_plan(), "from: 0.5", "from: 1.5")).find("the range is empty"),
            std::string::npos);
  EXPECT_NE(refusal(spoilt(drawn_plan(), "to: 1.5", "to: 1.5, values: [1]")).find("not both"),
            std::string::npos);
  EXPECT_NE(refusal(spoilt(drawn_plan(), "perturb.wind_mps", "perturb.friction")).find("twice"),
            std::string::npos);
  EXPECT_NE(refusal(drawn_plan() + "more: 1\n").find("more"), std::string::npos);
  EXPECT_NE(refusal(spoilt(drawn_plan(), "schema: 1", "schema: 2")).find("schema"),
            std::string::npos);
  EXPECT_NE(refusal("[").find("p.yaml"), std::string::npos);
}

TEST(SweepPlan, ARangeIsForDrawnCasesAlone) {
  EXPECT_NE(refusal(spoilt(spoilt(drawn_plan(), "draw", "all"), "cases: 40\n", ""))
                .find("a range is for combine: draw"),
            std::string::npos);
}

// A hundred million combinations are refused with their number.
TEST(SweepPlan, TooManyCombinationsAreToldBeforeAnythingStarts) {
  std::string values = "0";
  for (int i = 1; i < 100; ++i) values += ", " + std::to_string(i);
  std::string text = listed_plan("all", {});
  for (const char* path : {"a", "b", "c", "d"})
    text += std::string("  - {path: ") + path + ", values: [" + values + "]}\n";
  EXPECT_NE(refusal(text).find("100000000 cases, at most 1000000"), std::string::npos)
      << refusal(text);
  EXPECT_TRUE(read_plan(spoilt(text, "combine: all", "combine: pairs"), "p.yaml"))
      << "of pairs there are few enough";
}

}  // namespace
}  // namespace pitwall::sweep
