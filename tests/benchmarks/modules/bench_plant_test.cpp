// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/modules/bench_plant.hpp"

#include <gtest/gtest.h>

#include "tests/benchmarks/cost/cost_verdict.hpp"

namespace pitwall::benchmarks {
namespace {

class BenchPlant : public ProgramRun {};

// Whether the gates hold depends on the machine; that the code, the words and the file agree does
// not.
TEST_F(BenchPlant, CodeWordsAndFileSayTheSame) {
  const ProgramOutput output = run({"plant", "--json", path("plant.json")});
  ASSERT_TRUE(output.code == 0 || output.code == 1) << output.err;
  const auto json = json::JsonValue::parse(text_of("plant.json"), "plant.json");
  ASSERT_TRUE(json) << to_string(json.error());
  EXPECT_EQ(json->text("bench"), "plant");
  const double step_us = json->number("double_track_us");
  EXPECT_GE(json->number("double_track_median_us"), step_us);
  EXPECT_LT(json->number("single_track_us"), step_us);
  EXPECT_LT(json->number("kinematic_us"), step_us);
  EXPECT_GT(json->number("kinematic_us"), 0.0);
  EXPECT_LE(json->number("lockstep_median"), json->number("lockstep_times_real_time"));
  expect_one_verdict(output, *json,
                     {{"a step of the double track, median", 5.0},
                      {"a second of lockstep, median, 50 times real time", 1e6 / 50.0}});
  EXPECT_NE(output.out.find("[published]"), std::string::npos);  // of the peers
}

TEST_F(BenchPlant, WrongUsageIsTold) {
  expect_refusal({"plant", "--no-such-flag"}, "--no-such-flag");
  expect_refusal({"plant", "--json"}, "--json");
}

}  // namespace
}  // namespace pitwall::benchmarks
