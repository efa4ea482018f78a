// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/modules/bench_ekf.hpp"

#include <gtest/gtest.h>

#include "tests/benchmarks/cost/cost_verdict.hpp"

namespace pitwall::benchmarks {
namespace {

class BenchEkf : public ProgramRun {};

// Whether the gates of time hold depends on the machine; that the code, the words and the file
// agree does not, nor what was measured.
TEST_F(BenchEkf, CodeWordsAndFileSayTheSame) {
  const ProgramOutput output = run({"ekf", "--json", path("ekf.json")});
  ASSERT_TRUE(output.code == 0 || output.code == 1) << output.err;
  const auto json = json::JsonValue::parse(text_of("ekf.json"), "ekf.json");
  ASSERT_TRUE(json) << to_string(json.error());
  EXPECT_EQ(json->text("bench"), "ekf");
  const auto at = [&json](const std::string& name) { return json->number(name); };
  for (const std::string filter : {"spatial", "planar"}) {
    // Snapshots are taken for 40 s, four a second; in each, every rewind was possible.
    for (const std::string rewind : {"_rewind_100ms", "_rewind_1s"})
      EXPECT_GE(at(filter + rewind + "_calls"), 150.0) << filter << rewind;
    // The window of each snapshot holds 1.1 s of an IMU at 125 Hz.
    EXPECT_GE(at(filter + "_predict_calls"), 150.0 * 125.0) << filter;
    // Further back is more work.
    EXPECT_GT(at(filter + "_rewind_1s_p50_us"), 2.0 * at(filter + "_rewind_100ms_p50_us"));
  }
  for (const std::string kind : {"position", "velocity", "heading", "wheel_speed", "slip", "road"})
    EXPECT_GT(at("spatial_update_" + kind + "_calls"), 100.0) << kind;
  EXPECT_GT(at("step_rewind_100ms_calls"), 500.0);
  EXPECT_GT(at("step_rewind_calls"), at("step_rewind_100ms_calls"));
  EXPECT_EQ(at("step_allocations"), 0.0);
  expect_one_verdict(output, *json,
                     {{"predict, p50", 15.0},
                      {"update, p50, each kind", 30.0},
                      {"rewind of 100 ms, p50", 1'000.0},
                      {"rewind of 1 s, p50", 8'000.0},
                      {"step with a rewind of 100 ms, p99", 1'200.0},
                      {"no allocation in any step", 0.0}});
  EXPECT_NE(output.out.find("[published"), std::string::npos);  // of the peer
}

TEST_F(BenchEkf, WrongUsageIsTold) {
  expect_refusal({"ekf", "--no-such-flag"}, "--no-such-flag");
  expect_refusal({"ekf", "--json"}, "--json");
}

}  // namespace
}  // namespace pitwall::benchmarks
