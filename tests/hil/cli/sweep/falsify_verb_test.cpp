// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/sweep/falsify_verb.hpp"

#include <gtest/gtest.h>

#include "tests/hil/cli/program_run.hpp"

namespace pitwall::cli {
namespace {

// The car may not stand still for two seconds where the limit is below 0.
class FalsifyVerb : public ProgramRun {
 protected:
  void SetUp() override {
    ProgramRun::SetUp();
    std::string text =
        transport::read_file(std::string(PITWALL_SOURCE_DIR) + "/hil/scenarios/launch.yaml")
            .value_or("");
    text = text.substr(0, text.find("expect:")) +
           "expect:\n  - {kind: always, signal: speed_mps, is: \"<\", value: 1}\n";
    ASSERT_TRUE(transport::write_file(path("s.yaml"), text));
    write_plan("from: -0.2, to: 1");
  }

  void write_plan(const std::string& limit) {
    const std::string text = "schema: 1\nname: small\nscenario: " + path("s.yaml") +
                             "\nseed: 1\ncombine: draw\ncases: 1\nparameters:\n"
                             "  - {path: duration_s, values: [2]}\n"
                             "  - {path: \"expect[0].value\", " +
                             limit + "}\n";
    ASSERT_TRUE(transport::write_file(path("plan.yaml"), text));
  }
};

TEST_F(FalsifyVerb, WrongUsageIsTold) {
  expect_refusal({"falsify"}, "PLAN");
  expect_refusal({"falsify", path("none.yaml")}, "none.yaml");
  expect_refusal({"falsify", path("plan.yaml"), "--runs", "0"}, "--runs");
  write_plan("values: [1, 2]");
  expect_refusal({"falsify", path("plan.yaml")}, "nothing to search");
}

TEST_F(FalsifyVerb, WhatItFindsIsAScenarioThatMissesTheSame) {
  const ProgramOutput found = run({"falsify", path("plan.yaml"), "--out", path("f/found.yaml")});
  EXPECT_EQ(found.code, 1) << found.err;
  EXPECT_NE(found.out.find("always speed_mps < -"), std::string::npos) << found.out;
  const ProgramOutput again = run({"run", path("f/found.yaml")});
  EXPECT_EQ(again.code, 1) << again.out;
  EXPECT_NE(again.out.find("FAIL  always speed_mps < -"), std::string::npos) << again.out;
}

TEST_F(FalsifyVerb, WhereNothingIsWrongNothingIsFound) {
  write_plan("from: 0.5, to: 1");
  const ProgramOutput output =
      run({"falsify", path("plan.yaml"), "--runs", "12", "--out", path("found.yaml")});
  EXPECT_EQ(output.code, 0) << output.err;
  EXPECT_NE(output.out.find("nothing found"), std::string::npos) << output.out;
  EXPECT_FALSE(exists("found.yaml"));
}

}  // namespace
}  // namespace pitwall::cli
