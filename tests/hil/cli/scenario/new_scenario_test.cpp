// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/scenario/new_scenario.hpp"

#include <gtest/gtest.h>

#include "hil/bench/loading.hpp"
#include "hil/bench/lockstep/lockstep.hpp"
#include "hil/cli/bench_server/catalogue.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::cli {
namespace {

Result<bench::Loaded, Problem> loaded(const NewScenario& scenario) {
  return bench::load_text(new_scenario_text(scenario), "new.yaml", PITWALL_SOURCE_DIR);
}

class NewScenarioOn : public ::testing::TestWithParam<const char*> {};

TEST_P(NewScenarioOn, PassesAtItsShortest) {
  const std::string track = std::string("vehicle/config/tracks/") + GetParam() + ".yaml";
  const auto scenario = loaded({.name = "n", .track = track, .duration_s = kShortestNew_s});
  ASSERT_TRUE(scenario) << to_string(scenario.error());
  const auto run = bench::run_lockstep(*scenario, {});
  ASSERT_TRUE(run) << to_string(run.error());
  EXPECT_TRUE(run->passed()) << bench::to_text(*run);
  EXPECT_EQ(run->verdicts.size(), scenario->scenario.expect.size());
}

INSTANTIATE_TEST_SUITE_P(Tracks, NewScenarioOn, ::testing::Values("lvms", "ims", "tms"),
                         [](const auto& track) { return std::string{track.param}; });

TEST(NewScenario, AnyTextIsANameOrAPath) {
  for (const std::string text : {"it's", "a \"b\": c", "# no comment", "100%s", "[1, {2}]"}) {
    const auto read = scenario::read_scenario(
        new_scenario_text({.name = text, .track = text, .car = text, .duration_s = 31.5}), "n");
    ASSERT_TRUE(read) << to_string(read.error());
    EXPECT_EQ(read->name, text);
    EXPECT_EQ(read->track_file, text);
    EXPECT_EQ(read->car_file, text);
    EXPECT_EQ(read->duration, from_seconds(31.5));
  }
}

TEST(NewScenario, TheLineForTheEditorIsNoDescription) {
  const std::string text = new_scenario_text({.name = "n", .schema = "../s.json"});
  EXPECT_NE(text.find("\n# yaml-language-server: $schema=../s.json\n"), std::string::npos);
  EXPECT_EQ(bench_server::description_of(text).find("schema"), std::string::npos);
}

}  // namespace
}  // namespace pitwall::cli
