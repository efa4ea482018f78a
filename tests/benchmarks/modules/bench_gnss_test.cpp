// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/modules/bench_gnss.hpp"

#include <gtest/gtest.h>

#include "protocol/yaml/strict_map.hpp"
#include "tests/hil/cli/program_run.hpp"

namespace pitwall::benchmarks {

using cli::ProgramOutput;
using cli::ProgramRun;
namespace {

class BenchGnss : public ProgramRun {};

// Whether the gate holds depends on the machine; that the code, the words and the file agree does
// not. The rates are those of the receivers.
TEST_F(BenchGnss, CodeWordsAndFileSayTheSame) {
  const ProgramOutput output = run({"gnss", "--json", path("gnss.json")});
  ASSERT_TRUE(output.code == 0 || output.code == 1) << output.err;
  const auto json = yaml::load_file(path("gnss.json"));
  ASSERT_TRUE(json) << to_string(json.error());
  yaml::StrictMap map = json->root();
  EXPECT_EQ(map.text("bench"), "gnss");
  const double limit = map.number("gate_share", 0.0, 1.0);
  EXPECT_EQ(limit, 0.02);
  bool within = true;
  for (const std::string key : {"novatel_binary", "novatel_ascii", "vectornav"}) {
    const double share = map.number(key + "_share", 1e-9, 1e3);
    EXPECT_LE(map.number(key + "_least_share", 0.0, 1e3), share);
    EXPECT_GT(map.number(key + "_decode_share", 0.0, 1e3), 0.0);
    within = within && share <= limit;
    const double expected = key == "vectornav" ? 2.0 * (125 + 50 + 20) : 2.0 * (125 + 50 + 40 + 1);
    EXPECT_DOUBLE_EQ(map.number(key + "_logs_per_s", 0.0, 1e6), expected);
  }
  EXPECT_GT(map.number("novatel_ascii_bytes_per_s", 0.0, 1e9),
            map.number("novatel_binary_bytes_per_s", 0.0, 1e9));
  const bool held = map.flag("held");
  EXPECT_EQ(held, within);
  EXPECT_EQ(output.out.find("not every log"), std::string::npos);
  EXPECT_EQ(output.code, held ? 0 : 1);
  EXPECT_EQ(output.out.find("MISSED") == std::string::npos, held) << output.out;
}

TEST_F(BenchGnss, WrongUsageIsTold) {
  expect_refusal({"gnss", "--no-such-flag"}, "--no-such-flag");
  expect_refusal({"gnss", "--json"}, "--json");
}

}  // namespace
}  // namespace pitwall::benchmarks
