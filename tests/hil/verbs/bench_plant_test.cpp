// SPDX-License-Identifier: Apache-2.0
#include "hil/verbs/bench_plant.hpp"

#include <gtest/gtest.h>

#include "protocol/yaml/strict_map.hpp"
#include "tests/hil/verbs/program_run.hpp"

namespace pitwall::verbs {
namespace {

class BenchPlant : public ProgramRun {};

// Whether the gates hold depends on the machine; that the code, the words and the file agree does
// not.
TEST_F(BenchPlant, CodeWordsAndFileSayTheSame) {
  const Said said = run({"bench", "plant", "--json", path("plant.json")});
  ASSERT_TRUE(said.code == 0 || said.code == 1) << said.err;
  const auto json = yaml::load_file(path("plant.json"));
  ASSERT_TRUE(json) << to_string(json.error());
  yaml::StrictMap map = json->root();
  EXPECT_EQ(map.text("bench"), "plant");
  const double step_us = map.number("double_track_us", 1e-3, 1e6);
  const double lockstep = map.number("lockstep_times_real_time", 1e-3, 1e9);
  EXPECT_GE(map.number("double_track_median_us", 0.0, 1e6), step_us);
  EXPECT_LT(map.number("single_track_us", 1e-4, 1e6), step_us);
  EXPECT_LT(map.number("kinematic_us", 1e-4, 1e6), step_us);
  EXPECT_LE(map.number("lockstep_median", 1e-3, 1e9), lockstep);
  const bool held = map.flag("held");
  EXPECT_EQ(held, step_us <= 5.0 && lockstep >= 50.0);
  EXPECT_EQ(said.code, held ? 0 : 1);
  EXPECT_EQ(said.out.find("MISSED") == std::string::npos, held) << said.out;
  EXPECT_NE(said.out.find("[published]"), std::string::npos);  // of the peers
}

TEST_F(BenchPlant, WrongUsageIsTold) {
  expect_refusal({"bench", "plant", "--no-such-flag"}, "--no-such-flag");
  expect_refusal({"bench", "plant", "--json"}, "--json");
}

}  // namespace
}  // namespace pitwall::verbs
