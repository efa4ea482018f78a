// What can be told of the demonstration without starting it; the rest is tests/system/live.
// SPDX-License-Identifier: Apache-2.0
#include "hil/verbs/demo_verb.hpp"

#include <gtest/gtest.h>

#include "tests/hil/verbs/program_run.hpp"

namespace pitwall::verbs {
namespace {

class DemoVerb : public ProgramRun {};

TEST_F(DemoVerb, WrongUsageIsTold) {
  expect_refusal({"demo", "--no-such-flag"}, "--no-such-flag");
  expect_refusal({"demo", "surplus"}, "surplus");
  expect_refusal({"demo", "--duration", "0"}, "--duration");
  expect_refusal({"demo", "--duration", "long"}, "long");
}

TEST_F(DemoVerb, HelpIsNoError) {
  const Said said = run({"demo", "--help"});
  EXPECT_EQ(said.code, 0);
  EXPECT_NE(said.out.find("--headless"), std::string::npos);
}

TEST_F(DemoVerb, ABadScenarioIsToldWithItsPlaceAndNothingIsStarted) {
  const std::string bad = spoilt("launch_and_stop.yaml", "seed: 11", "seed: eleven");
  expect_refusal({"demo", "--headless", "--scenario", bad, "--out", path("demo")},
                 bad + ":4:7: error: ");
  EXPECT_FALSE(exists("demo"));
  expect_refusal({"demo", "--scenario", path("none.yaml"), "--out", path("demo")},
                 path("none.yaml"));
  EXPECT_FALSE(exists("demo"));
}

TEST_F(DemoVerb, AFolderThatCannotBeMadeIsTold) {
  ASSERT_TRUE(transport::write_file(path("file"), "in the way"));
  expect_refusal({"demo", "--headless", "--out", path("file/demo")}, path("file/demo"));
  EXPECT_EQ(run({"demo", "--headless", "--out", path("file/demo")}).out, "");
}

}  // namespace
}  // namespace pitwall::verbs
