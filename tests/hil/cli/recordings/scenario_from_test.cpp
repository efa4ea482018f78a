// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/recordings/scenario_from.hpp"

#include <gtest/gtest.h>

#include "hil/scenario/scenario.hpp"
#include "tests/hil/bench/recorded/recorded_drive.hpp"
#include "tests/hil/cli/program_run.hpp"

namespace pitwall::cli {
namespace {

class ScenarioFrom : public ProgramRun {};

TEST_F(ScenarioFrom, WrongUsageIsTold) {
  expect_refusal({"scenario", "from"}, "RECORDING");
  expect_refusal({"scenario", "from", "/nowhere"}, "/nowhere");
  expect_refusal({"scenario", "from", bench::recorded_folder(), "--out", "/nowhere/made.yaml"},
                 "/nowhere/made.yaml");
}

TEST_F(ScenarioFrom, MakesAScenarioThatTheBenchReads) {
  const ProgramOutput ran =
      run({"scenario", "from", bench::recorded_folder(), "--out", path("made.yaml")});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_EQ(ran.out, "");
  const auto made = scenario::read_scenario(text_of("made.yaml"), "made.yaml");
  ASSERT_TRUE(made) << to_string(made.error());
  EXPECT_EQ(made->track_file, bench::RecordedDrive::path_of("tracks/lvms.yaml"));
  const ProgramOutput shown = run({"scenario", "from", bench::recorded_folder()});
  EXPECT_EQ(shown.out, text_of("made.yaml"));
}

}  // namespace
}  // namespace pitwall::cli
