// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/modules/bench_dbc.hpp"

#include <gtest/gtest.h>

#include "protocol/yaml/strict_map.hpp"
#include "tests/hil/cli/program_run.hpp"

namespace pitwall::benchmarks {

using cli::ProgramOutput;
using cli::ProgramRun;
namespace {

class BenchDbc : public ProgramRun {};

// Whether the gates hold depends on the machine; that the code, the words and the file agree does
// not.
TEST_F(BenchDbc, CodeWordsAndFileSayTheSame) {
  const ProgramOutput output = run({"dbc", "--json", path("dbc.json")});
  ASSERT_TRUE(output.code == 0 || output.code == 1) << output.err;
  const auto json = yaml::load_file(path("dbc.json"));
  ASSERT_TRUE(json) << to_string(json.error());
  yaml::StrictMap map = json->root();
  EXPECT_EQ(map.text("bench"), "dbc");
  const double decoded_per_s = map.number("decode_plans_per_s", 0.0, 1e12);
  const double parse_ms = map.number("parse_ms", 0.0, 1e9);
  EXPECT_GT(map.number("decode_generated_per_s", 0.0, 1e12), 0.0);
  EXPECT_GT(map.number("encode_plans_per_s", 0.0, 1e12), 0.0);
  EXPECT_GT(map.number("encode_generated_per_s", 0.0, 1e12), 0.0);
  EXPECT_GE(map.integer("parse_bytes", 0, 1'000'000'000), 800'000);
  const bool held = map.flag("held");
  EXPECT_EQ(held, decoded_per_s >= 20e6 && parse_ms < 100.0);
  EXPECT_EQ(output.code, held ? 0 : 1);
  EXPECT_EQ(output.out.find("MISSED") == std::string::npos, held) << output.out;
}

TEST_F(BenchDbc, WrongUsageIsTold) {
  expect_refusal({"dbc", "--no-such-flag"}, "--no-such-flag");
  expect_refusal({"dbc", "--json"}, "--json");
}

}  // namespace
}  // namespace pitwall::benchmarks
