// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/recordings/compare_verb.hpp"

#include <gtest/gtest.h>

#include "tests/hil/bench/recorded/recorded_drive.hpp"
#include "tests/hil/cli/program_run.hpp"

namespace pitwall::cli {
namespace {

class CompareVerb : public ProgramRun {
 protected:
  std::string recording() const { return bench::recorded_folder(); }
};

TEST_F(CompareVerb, WrongUsageIsTold) {
  expect_refusal({"compare"}, "RECORDING");
  expect_refusal({"compare", "/nowhere"}, "/nowhere");
  expect_refusal({"compare", recording(), "--tolerance", "ego.vx"}, "expected SIGNAL=VALUE");
  expect_refusal({"compare", recording(), "--tolerance", "ego.vx=-1"}, "expected SIGNAL=VALUE");
  expect_refusal({"compare", recording(), "--car", "/nowhere.yaml"}, "/nowhere.yaml");
}

TEST_F(CompareVerb, ARunDrivenAgainByTheSameBuildDiffersInNothing) {
  const ProgramOutput said = run({"compare", recording(), "--json", path("same.json")});
  EXPECT_EQ(said.code, 0) << said.err;
  EXPECT_NE(said.out.find("300 ticks driven again, "), std::string::npos) << said.out;
  EXPECT_NE(said.out.find(": 0 signals differ"), std::string::npos) << said.out;
  EXPECT_NE(said.out.find("fields that the process measures of itself"), std::string::npos);
  EXPECT_NE(text_of("same.json").find(R"("differences": [])"), std::string::npos)
      << text_of("same.json");
}

TEST_F(CompareVerb, WithAnotherTrackItDiffersAndSaysWhere) {
  const ProgramOutput said = run({"compare", recording(), "--track",
                                  "vehicle/config/tracks/ims.yaml", "--json", path("other.json")});
  EXPECT_EQ(said.code, 1) << said.err;
  EXPECT_NE(said.err.find("ims.yaml: not the file that the run was driven with"), std::string::npos)
      << said.err;
  EXPECT_NE(said.out.find("values differ"), std::string::npos) << said.out;
  EXPECT_NE(said.out.find("  first "), std::string::npos) << said.out;
  EXPECT_NE(text_of("other.json").find(R"("signal": )"), std::string::npos);
}

}  // namespace
}  // namespace pitwall::cli
