// SPDX-License-Identifier: Apache-2.0
#include "hil/verbs/bench_verb.hpp"

#include <gtest/gtest.h>

#include "protocol/yaml/strict_map.hpp"
#include "tests/hil/verbs/program_run.hpp"

namespace pitwall::verbs {
namespace {

class BenchVerb : public ProgramRun {};

TEST_F(BenchVerb, WrongUsageIsTold) {
  expect_refusal({"bench"}, "name");
  expect_refusal({"bench", "lockstop"}, "unknown name \"lockstop\"");
  expect_refusal({"bench", "lockstop"}, "known: dbc, ");
  expect_refusal({"bench", "step", "--no-such-flag"}, "--no-such-flag");
}

// Whether the gate holds depends on the machine; that the code, the words and the file agree does
// not.
TEST_F(BenchVerb, CodeWordsAndFileSayTheSame) {
  const Said said = run({"bench", "step", "--json", path("step.json")});
  ASSERT_TRUE(said.code == 0 || said.code == 1) << said.err;
  const auto json = yaml::load_file(path("step.json"));
  ASSERT_TRUE(json) << to_string(json.error());
  yaml::StrictMap map = json->root();
  EXPECT_EQ(map.text("bench"), "step");
  const double p50_us = map.number("p50_us", 0.0, 1e9), p99_us = map.number("p99_us", 0.0, 1e9);
  EXPECT_LE(p50_us, p99_us);
  EXPECT_LE(p99_us, map.number("max_us", 0.0, 1e9));
  EXPECT_GT(p50_us, 0.0);
  const bool held = map.flag("held");
  EXPECT_EQ(held, p50_us < 100.0 && p99_us < 1'200.0);
  EXPECT_EQ(said.code, held ? 0 : 1);
  EXPECT_NE(said.out.find(held ? "held" : "MISSED"), std::string::npos);
}

TEST_F(BenchVerb, AFileThatCannotBeWrittenIsAFailure) {
  const Said said = run({"bench", "step", "--json", path("no/such/step.json")});
  EXPECT_EQ(said.code, 2);
  EXPECT_NE(said.err.find("no/such"), std::string::npos);
}

}  // namespace
}  // namespace pitwall::verbs
