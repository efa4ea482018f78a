// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/step/bench_step.hpp"

#include <gtest/gtest.h>

#include "tests/benchmarks/cost/cost_verdict.hpp"

namespace pitwall::benchmarks {
namespace {

class BenchStep : public ProgramRun {};

TEST_F(BenchStep, WrongUsageIsTold) {
  expect_refusal({}, "NAME");
  expect_refusal({"lockstop"}, "unknown benchmark \"lockstop\"");
  expect_refusal({"lockstop"}, "  dbc ");
  expect_refusal({"step", "--no-such-flag"}, "--no-such-flag");
}

// Whether the gate holds depends on the machine; that the code, the words and the file agree does
// not.
TEST_F(BenchStep, CodeWordsAndFileSayTheSame) {
  const ProgramOutput output = run({"step", "--json", path("step.json")});
  ASSERT_TRUE(output.code == 0 || output.code == 1) << output.err;
  const auto json = json::JsonValue::parse(text_of("step.json"), "step.json");
  ASSERT_TRUE(json) << to_string(json.error());
  EXPECT_EQ(json->text("bench"), "step");
  EXPECT_GT(json->number("p50_us"), 0.0);
  EXPECT_LE(json->number("p50_us"), json->number("p99_us"));
  EXPECT_LE(json->number("p99_us"), json->number("max_us"));
  expect_one_verdict(output, *json, {{"a step, p50", 100.0}, {"a step, p99", 1'200.0}});
}

TEST_F(BenchStep, AFileThatCannotBeWrittenIsAFailure) {
  const ProgramOutput output = run({"step", "--json", path("no/such/step.json")});
  EXPECT_EQ(output.code, 2);
  EXPECT_NE(output.err.find("no/such"), std::string::npos);
}

}  // namespace
}  // namespace pitwall::benchmarks
